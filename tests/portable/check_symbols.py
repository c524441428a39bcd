#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""The undefined symbols of the portable rooms: none of files, threads, CHOLMOD, BLAS. Usage: check_symbols.py NM LIBRARY"""
import re
import subprocess
import sys

forbidden = re.compile(r'^(f?open(64)?|fdopen|fclose|fread|fwrite|fopen64|read|write|close|rename|unlink|stat|mkstemp.*|'
                       r'pthread_.*|sem_.*|cholmod_.*|openblas_.*|[sd](gemm|potrf|trsm|syrk)_|dl(open|sym|addr))$')
names = subprocess.run([sys.argv[1], '-u', sys.argv[2]], capture_output=True, text=True, check=True).stdout.split()
names = {name for name in names if not name.endswith(':') and name != 'U'}
found = sorted(name for name in names if forbidden.match(name))
if not names:
    sys.exit('no symbols read from ' + sys.argv[2])
if found:
    sys.exit('the portable rooms need ' + ', '.join(found))
print(len(names), 'undefined symbols, none forbidden')
