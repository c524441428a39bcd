#!/bin/sh
# SPDX-License-Identifier: MIT
# Compares the page of the manual with the one that the program describe makes. Usage: manual.sh DESCRIBE PAGE
"$1" manual | diff "$2" - || { echo "write it again: build/plugins/meshlab/describe manual >docs/meshlab-filters.md"; exit 1; }
