# SPDX-License-Identifier: BSD-3-Clause
"""Fails where a library or a program loads a library that it must do without.

    check_libraries.py --never PATTERN FILE [FILE …]
"""

import argparse
import re
import subprocess
import sys


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--never", required=True)
    parser.add_argument("files", nargs="+")
    arguments = parser.parse_args()
    failed = False
    for file in arguments.files:
        listing = subprocess.run(["ldd", file], check=True, capture_output=True, text=True).stdout
        libraries = [line.split()[0] for line in listing.splitlines()]
        found = [name for name in libraries if re.search(arguments.never, name)]
        print(f"{file}: {len(libraries)} libraries")
        if not any("libc.so" in name for name in libraries) or found:
            print(f"  among them {', '.join(found) or 'no C library: ldd tells nothing'}")
            failed = True
    return 1 if failed else 0


if __name__ == "__main__":
    sys.exit(main())
