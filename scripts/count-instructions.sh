#!/bin/sh
# A feature that does nothing costs nothing: instructions of 20 steps with and without it, counted by valgrind
# (which runs the AVX2 lanes), may differ by 0.1 %, and the results must agree bit for bit.
# Exit code 0 fine, 1 a feature costs or changes something, 2 nothing could be counted.
set -eu
cd "$(dirname "$0")/.."
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 2; }
cargo build --release --quiet -p proctor-kernel --example do_nothing
binary="${CARGO_TARGET_DIR:-target}/release/examples/do_nothing"
log=$(mktemp)
trap 'rm -f "$log"' EXIT

# Prints "INSTRUCTIONS HASH".
count() {
    hash=$(valgrind --tool=callgrind --callgrind-out-file=/dev/null "$binary" "$1" 2>"$log")
    echo "$(sed -n 's/.*Collected *: *\([0-9]*\).*/\1/p' "$log") $hash"
}

failed=0

# compare BASE FEATURE...
compare() {
    name=$1
    shift
    features=$*
    set -- $(count "$name")
    base=$1
    base_hash=$2
    [ "$base" -gt 0 ] || { echo "valgrind counted nothing" >&2; exit 2; }
    printf '%-16s %12s instructions\n' "$name" "$base"
    for feature in $features; do
        set -- $(count "$feature")
        verdict=ok
        [ "$2" = "$base_hash" ] || verdict="CHANGES THE RESULT"
        difference=$(awk -v a="$1" -v b="$base" 'BEGIN { printf "%+.4f", 100 * (a - b) / b }')
        awk -v d="$difference" 'BEGIN { exit !(d > 0.1) }' && verdict="COSTS MORE THAN 0.1 %"
        [ "$verdict" = ok ] || failed=1
        printf '%-16s %12s instructions %9s %%  %s\n' "$feature" "$1" "$difference" "$verdict"
    done
}

compare none local-damping viscous-damping second-material far-plane zero-load
compare far-body far-contact
exit $failed
