#!/bin/sh
# Draws the pictures of README.md and the guide anew:  docs/pictures/make.sh build/release/apps/carom/carom
set -eu
carom=$(realpath "$1")
cd "$(dirname "$0")"
scratch=$(mktemp -d)
trap 'rm -r "$scratch"' EXIT

# The scene NAME of a page of the guide, as it stands there.
scene() { awk -v name="$2" '$0 == "```json " name { on = 1; next } on && /^```/ { exit } on' "../guide/$1" >"$scratch/$2"; }

scene 04-springs-ropes-cloth.md cloth.json
"$carom" render "$scratch/cloth.json" --file cloth.png --at 0.9 >/dev/null

scene 05-gas.md gas.json
"$carom" plot "$scratch/gas.json" --out "$scratch" >/dev/null && cp "$scratch/snapshots.png" gas.png

"$carom" plot ../../scenes/honesty/gas-of-boxes.json --out "$scratch" >/dev/null && cp "$scratch/snapshots.png" gas-of-boxes.png

scene 07-driven-bodies.md kapitza.json
"$carom" plot "$scratch/kapitza.json" --out "$scratch" >/dev/null && cp "$scratch/time.png" kapitza.png

scene 08-energy.md books.json
"$carom" plot "$scratch/books.json" --out "$scratch" >/dev/null && cp "$scratch/books.png" .

scene 10-pictures-and-data.md pendulum.json
"$carom" plot "$scratch/pendulum.json" --out "$scratch" >/dev/null && cp "$scratch/trajectories.png" spring-pendulum.png

scene 10-pictures-and-data.md duffing.json
"$carom" plot "$scratch/duffing.json" --out "$scratch" >/dev/null && cp "$scratch/phase.png" duffing.png

# 48 colours are enough for lines on white, and make a file a third as large.
for file in *.png; do
    ffmpeg -v error -y -i "$file" -vf "split[a][b];[a]palettegen=max_colors=48[p];[b][p]paletteuse=dither=none" \
        "$scratch/small.png" && mv "$scratch/small.png" "$file"
done
