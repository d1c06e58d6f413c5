"""What the program says of itself: help, version; and that the examples of the help work."""

import glob
import os
import re
import shlex

import carom

COMMANDS = ("run", "plot", "render", "check", "bench", "validate", "schema", "tour")


class Help(carom.Case):
    def test_without_arguments_there_is_help(self):
        self.assertEqual(self.succeeds().stdout, self.succeeds("--help").stdout)

    def test_help_was_no_command(self):
        self.assertEqual(self.succeeds("help").stdout, self.succeeds("--help").stdout)
        self.assertIn("carom help COMMAND", self.succeeds("help").stdout)
        for command in COMMANDS:
            self.assertEqual(self.succeeds("help", command).stdout, self.succeeds(command, "--help").stdout)
        self.fails(2, "there is no command 'rum'; there are run, plot", "help", "rum")

    # What came was a list of commands, and run is hardly seen among them.
    def test_a_scene_in_place_of_a_command(self):
        scene = self.write(carom.FALL)
        self.fails(2, f"'{scene}' is no command; did you mean 'carom run {scene}'?", scene)

    def test_an_option_that_there_is_not_was_told_to_be_a_command_that_is_missing(self):
        for option in "-v", "--verison":
            self.fails(2, f"there is no option '{option}' (carom --help shows what there is)", option)
        self.fails(2, "not expected: --verison", "run", "--verison", "scene.json")

    def test_help_names_all_commands_and_the_exit_status(self):
        text = self.succeeds("--help").stdout
        for command in COMMANDS:
            self.assertRegex(text, rf"\n  {command} ")
        self.assertIn("exit status: 0 all went well", text)
        self.assertIn("example", text)

    def test_every_command_has_an_example_of_its_own(self):
        for command in COMMANDS:
            self.assertRegex(self.succeeds(command, "--help").stdout, rf"examples?:\n  carom {command}")

    # Three of run's first examples ended with FAIL, and one read a checkpoint that is never there.
    def test_examples_failed(self):
        os.symlink(carom.SCENES, self.path / "scenes")
        for command in ("", *COMMANDS):
            for example in re.findall(r"^  carom (.*)$", self.succeeds(*command.split(), "--help").stdout, re.M):
                # Long; scenes that are tests themselves; a shell's business; wants a run that was killed.
                if re.search(r"\.mp4|^tour|--checkpoint|^run .*\*|>|--resume", example):
                    continue
                arguments = [file for word in shlex.split(example) for file in (
                    sorted(glob.glob(word, root_dir=self.path)) if "*" in word else [word])]
                with self.subTest(example=example):
                    ran = self.carom(*arguments)
                    self.assertEqual(ran.returncode, 0, ran.stdout + ran.stderr)
                    self.assertEqual(carom.without_notes(ran.stderr), "")

    def test_lines_are_not_endless(self):
        for command in COMMANDS:
            for line in self.succeeds(command, "--help").stdout.splitlines():
                self.assertLess(len(line), 160, line)

    def test_version(self):
        self.assertRegex(self.succeeds("--version").stdout, r"^carom \d+\.\d+\.\d+\n$")


if __name__ == "__main__":
    carom.main()
