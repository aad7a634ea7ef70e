#!/usr/bin/env bash
# Draws the pictures of strokes that follow the form, in this folder.
set -euo pipefail
cd "$(dirname "$0")"
draw() { cargo run --quiet --release -p tam-viewer -- --quiet render --size 480x480 --force --out "surface-$1.png" "${@:2}"; }
draw head-engraved --mesh head --map engraving --method stripes --variety 0.6
draw head-fine-pen --mesh head --map fine-pen --mapping patches
draw knot-ballpoint --mesh torus-knot --map ballpoint --mapping patches
draw teapot-pencil --mesh teapot --map pencil --mapping patches --blend linear
draw gyroid-engraved --mesh gyroid --map engraving --method stripes
draw chair-woodcut --mesh chair --map woodcut --mapping patches --method stroke-map --colours none --tiles 3
draw hand-charcoal --mesh hand --map charcoal --mapping patches --camera=150,10 --light 110,50
draw hand-brush --mesh hand --map brush --mapping patches --method stroke-map --tiles 2
