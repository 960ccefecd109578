#!/bin/sh
# Makes contact-sheet.png, the picture of the families in docs/gallery.md: the facets, the ASET and a render of each family's first cut.
# It runs in the top folder of the source and needs ImageMagick. The program is the first argument, or `brillianteer`.
set -e
program=${1:-brillianteer}
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
side=140
tiles=
for cut in single-cut portuguese rose briolette oval marquise pear heart cushion trillion emerald asscher baguette \
    tapered-baguette kite hexagon princess radiant modified-cushion barion cushion-barion oval-barion; do
    made="$work/$cut"
    "$program" render cuts/$cut.toml --light studio --overlay wireframe --samples 1 --size $side --out "$made-facets.png"
    "$program" render cuts/$cut.toml --light studio --size $side --out "$made-studio.png"
    "$program" export cuts/$cut.toml --views aset --size $side --out "$made"
    # A heart, which is not convex, is traced by rays, which give the strongest light alone.
    aset="$made/$cut-aset.png"
    if [ ! -e "$aset" ]; then aset="$made/$cut-aset-strongest.png"; fi
    montage "$made-facets.png" "$aset" "$made-studio.png" -tile 3x1 -geometry ${side}x${side}+2+2 \
        -background white "$made-row.png"
    convert "$made-row.png" -background white -gravity south -splice 0x16 -font "$(fc-match -f %{file} sans)" -pointsize 12 -annotate +0+2 \
        "$(sed -n 's/^name = "\(.*\)"/\1/p' cuts/$cut.toml)" "$made-tile.png"
    tiles="$tiles $made-tile.png"
done
montage $tiles -tile 2x -geometry +6+4 -background white -depth 8 -colors 128 png8:docs/images/contact-sheet.png
