#!/bin/sh
# A feature that does nothing costs nothing: instructions per particle and step with and without it may differ by
# 0.1 %, and the results must agree bit for bit. All counts: cargo bench --bench instructions.
# Exit code 0 fine, 1 a feature costs or changes something, 2 nothing could be counted.
set -eu
cd "$(dirname "$0")/.."
command -v valgrind >/dev/null || { echo "valgrind is not installed" >&2; exit 2; }
exec cargo bench --quiet -p proctor-benchmark --bench instructions -- --features "$@"
