#!/bin/sh
# SPDX-License-Identifier: MIT
# Sees whether the page of the HTML exporter can be built, and gets its npm packages: prepare.sh SOURCE BUILD CLANG
# Exit 0: clang makes WebAssembly with a C library, and BUILD/node_modules is what package-lock.json says.
set -eu
source=$1 build=$2 clang=$3
mkdir -p "$build"

printf '#include <math.h>\n#include <stdlib.h>\ndouble f(double x) { double *p = malloc(8); *p = x; return pow(*p, x); }\n' >"$build/probe.c"
"$clang" --target=wasm32-wasi -mexec-model=reactor -Wl,--export=f -o "$build/probe.wasm" "$build/probe.c" ||
  { echo "$clang makes no WebAssembly: packages lld, wasi-libc and libclang-rt-14-dev-wasm32 are needed" >&2; exit 1; }
rm -f "$build/probe.c" "$build/probe.wasm"

if [ -d "$build/node_modules" ] && cmp -s "$source/package-lock.json" "$build/package-lock.json"; then exit 0; fi
rm -rf "$build/node_modules" "$build/package-lock.json"
cp "$source/package.json" "$build/package.json"
cp "$source/package-lock.json" "$build/package-lock.json.new"
mv "$build/package-lock.json.new" "$build/package-lock.json"
cd "$build"
if ! npm ci --ignore-scripts --prefer-offline --fetch-retries=1 --fetch-retry-mintimeout=2000 --no-audit --no-fund --loglevel=error; then
  rm -rf node_modules package-lock.json
  echo "npm ci did not get the packages of web/package-lock.json" >&2
  exit 1
fi
