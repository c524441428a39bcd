#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Formats the sources in C and C++ with clang-format 14. Usage: scripts/format.sh [--check]      --check: only say what differs
set -euo pipefail

cd "$(dirname "${BASH_SOURCE[0]}")/.."
format=$(command -v clang-format-14 || command -v clang-format) ||
  { echo "$0: needs clang-format-14: scripts/deps --all" >&2; exit 1; }
version=$("$format" --version)
case "$version" in
  *"version 14."*) ;;
  *) echo "$0: needs version 14, found: $version" >&2; exit 1 ;;
esac
case "${1:-}" in
  '') mode=(-i) ;;
  --check) mode=(--dry-run --Werror) ;;
  *) echo "usage: $0 [--check]" >&2; exit 2 ;;
esac
find include core exporters cli samples tests bench plugins web -type f \( -name '*.c' -o -name '*.h' -o -name '*.cc' \) -print0 2>/dev/null |
  sort -z | xargs -0 -r "$format" "${mode[@]}"
