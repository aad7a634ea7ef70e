#!/usr/bin/env bash
# Measures the charts of the README and puts them in this folder, their figures beside.
set -euo pipefail
cd "$(dirname "$0")"
made=$(mktemp -d)
trap 'rm -r "$made"' EXIT
cargo run --quiet --release -p tam-viewer -- --quiet chart --mesh hand --map pencil -o "$made/frames"
cargo run --quiet --release -p tam-gen -- --quiet chart pencil -o "$made/placement"
for chart in tone direction edges orbit; do cp "$made/frames/$chart.png" "chart-$chart.png"; done
cp "$made/frames/points.csv" chart-frames.csv
cp "$made/placement/box-cv-1.png" chart-placement.png
cp "$made/placement/points.csv" chart-placement.csv
