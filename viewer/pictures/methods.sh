#!/usr/bin/env bash
# Draws the engraved head, the sheet of all methods and mappings, and the room, in this folder.
set -euo pipefail
cd "$(dirname "$0")"
viewer() { cargo run --quiet --release -p tam-viewer -- --quiet "$@" --force; }
viewer render --mesh head --map engraving --method stroke-map --mapping patches --size 900x900 --out head.png
viewer render --scene room.toml --size 1000x640 --out room.png
viewer compare --mesh torus-knot --map fine-pen --size 400x400 --out methods.png
