// No test: a program for the sake of the headers that all of them have in common.
