#!/bin/sh
# Makes glass-sheet.jpg, a contact sheet of the scenes of glass, the rings and the worlds that the program draws: each is rendered
# 1024 pixels wide and high, or as many as the third argument says, and shown 340 wide. It runs in the top folder of the source and
# needs ImageMagick. The program is the first argument, or `brillianteer`; the second is the folder that keeps the large pictures, or
# a temporary one.
set -e
program=${1:-brillianteer}
work=${2:-$(mktemp -d)}
side=${3:-1024}
mkdir -p "$work"
tiles=
label() {
    convert "$1" -resize 340x340 -background white -gravity south -splice 0x18 -font "$(fc-match -f %{file} sans)" \
        -pointsize 13 -annotate +0+2 "$2" "$1-tile.png"
    tiles="$tiles $1-tile.png"
}
for scene in subtle-pill prism-rainbow rotating-cube wavy-plate free-diamond; do
    [ -e "$work/$scene.png" ] || "$program" render scenes/$scene.toml --samples 6 --size $side --out "$work/$scene.png"
    label "$work/$scene.png" "$(sed -n 's/^name = "\(.*\)"/\1/p' scenes/$scene.toml)"
done
for scene in solitaire four-prong halo-ring eternity; do
    [ -e "$work/$scene.png" ] || "$program" render scenes/$scene.toml --wavelengths 8 --samples 6 --size $side --out "$work/$scene.png"
    label "$work/$scene.png" "$(sed -n 's/^name = "\(.*\)"/\1/p' scenes/$scene.toml)"
done
# Two stones keep clear of the middle of each world, so that it is seen, and in the stones what they make of it.
for world in sunset:0.5 room:0.5 city:1.2; do
    exposure=${world#*:}
    world=${world%:*}
    cat > "$work/$world.toml" << END
format = 1
name = "World: $world"
light = "$world"
background = "$world"
angle_of_view = 45.0
exposure = $exposure

[[stone]]
cut = "modern-ideal"
size = "8mm"
turn = 10.0
tilt = 24.0
azimuth = 150.0
at = [5.0, -3.5, 0.0]

[[stone]]
cut = "modern-ideal"
size = "3.5mm"
turn = 10.0
tilt = 30.0
azimuth = 40.0
at = [-7.5, 6.0, 0.0]
END
    [ -e "$work/$world.png" ] || "$program" render "$work/$world.toml" --samples 6 --size $side --out "$work/$world.png"
    label "$work/$world.png" "World: $world"
done
montage $tiles -tile 4x -geometry +4+4 -background white -depth 8 -quality 85 docs/images/glass-sheet.jpg
