#!/usr/bin/env bash
# SPDX-License-Identifier: BSD-3-Clause
# Builds the suite for /usr and makes a Debian package of it: command, libraries, headers, Python module, messages, launch files.
#   scripts/make_deb.sh [FOLDER]     writes FOLDER/urban-nav_VERSION_ARCHITECTURE.deb (default: build/deb)
set -eu
# shellcheck source=scripts/lib.sh
. "$(dirname "$(readlink -f "$0")")/lib.sh"
target=$(realpath -m "${1:-$build/deb}")

use_system_tools
install_packages dpkg-dev file
lock
configure "$build/package" -DCATKIN_BUILD_BINARY_PACKAGE=ON -DCATKIN_ENABLE_TESTING=OFF -DURBAN_NAV_UNITY="${URBAN_NAV_UNITY:-ON}" \
  -DCMAKE_INSTALL_PREFIX=/usr
compile "$build/package" "Building the package" all || die "the suite does not compile"
mkdir -p "$target"
(cd "$build/package/build" && cpack -G DEB -B "$target/files") >"$build/package/cpack.log" 2>&1 || {
  tail -20 "$build/package/cpack.log" >&2
  die "cpack failed (all of it: build/package/cpack.log)"
}
mv "$target"/files/*.deb "$target/"
rm -rf "$target/files"
ls "$target"/*.deb
