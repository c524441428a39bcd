#!/usr/bin/env bash
# SPDX-License-Identifier: MIT
# Compiles the plugins, without linking, against the headers of newer releases of MeshLab.
# Usage: newer.sh FOLDER     FOLDER/RELEASE has src/common, src/vcglib (or vcglib) and ML_VERSION of each of the releases below
# Exit status 77 (skipped) where FOLDER is empty or has none of them.
set -euo pipefail

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
folder=${1:-}
read -ra qt <<<"$(pkg-config --cflags Qt5Widgets Qt5OpenGL Qt5Xml Qt5Network 2>/dev/null || true)"
n_compiled=0
for release in 2022.02 2023.12 2025.07; do
  headers=$folder/$release
  if [ -z "$folder" ] || [ ! -f "$headers/ML_VERSION" ]; then
    echo "$release: no headers in ${folder:-the folder of the option meshlab_newer}"
    continue
  fi
  vcglib=$headers/src/vcglib
  [ -d "$vcglib/vcg" ] || vcglib=$headers/vcglib
  for file in filters formats; do
    "${CXX:-c++}" -fsyntax-only -std=c++17 -Wall -Wextra -Wpedantic -fPIC "${qt[@]/#-I/-isystem}" -isystem /usr/include/eigen3 \
      -isystem "$headers/src" -isystem "$vcglib" -DMESHLAB_SCALAR=float "-DMESHLAB_VERSION=$release" \
      -DFS_MESHLAB_GENERATION=2021 -I "$root/include" "$root/plugins/meshlab/${file}_2021.cc"
    echo "$release: $file compile"
    n_compiled=$((n_compiled + 1))
  done
done
[ "$n_compiled" -gt 0 ] || exit 77
