#!/usr/bin/env bash
# Does a fresh clone work with nothing but Rust? Clones this repository's HEAD into a temporary folder and runs there
# the two commands of the README, with no build left over from here.
set -euo pipefail
source=$(git -C "$(dirname "$0")" rev-parse --show-toplevel)
clone=$(mktemp -d)
trap 'rm -rf "$clone"' EXIT

git clone --quiet "$source" "$clone/proctor"
cd "$clone/proctor"
unset CARGO_TARGET_DIR
cargo run --release
cargo test
