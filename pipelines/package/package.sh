#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Makes the release: a source archive and a Debian package, checks the package with lintian, installs it into a fresh
# minimal Debian 12 and runs a phantom there.
#
#   bash pipelines/package/package.sh [--out DIR] [--no-install] [--no-root]     --no-root: without the minimal Debian
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../setup.sh"
out=$root/packages
install=yes
try=yes

while [ $# -gt 0 ]; do
  case $1 in
    --out)
      out=$(realpath -m "$2")
      shift
      ;;
    --no-install) install=no ;;
    --no-root) try=no ;;
    *)
      echo "usage: bash pipelines/package/package.sh [--out DIR] [--no-install] [--no-root]" >&2
      exit 2
      ;;
  esac
  shift
done

[ $install = no ] || install_packages help2man lintian dpkg-dev fakeroot mmdebstrap
mkdir -p "$out"
build "$root/build" brainshift -DCMAKE_BUILD_TYPE=Release
cmake --build "$root/build" --target man_pages

(cd "$root" && git archive --prefix=brainshift/ --output="$out/brainshift-source.tar.gz" HEAD)
cpack --config "$root/build/CPackConfig.cmake" -G DEB -B "$out"
package=$(ls -t "$out"/brainshift_*.deb | head -n 1)
echo "Checking $package"
lintian --fail-on error "$package"

if [ $try = yes ]; then
  chroot=$(mktemp -d)
  trap 'rm -rf "$chroot"' EXIT
  depends=$(dpkg-deb --field "$package" Depends | sed 's/([^)]*)//g; s/|[^,]*//g; s/ //g')
  mmdebstrap --variant=minbase --include="$depends" bookworm "$chroot"
  cp "$package" "$chroot/tmp/brainshift.deb"
  chroot "$chroot" dpkg -i /tmp/brainshift.deb
  chroot "$chroot" sh -ec 'cd /tmp
    brainshift --version
    brainshift phantom --size 48 --out head
    brainshift run head/scene.xml --out run --set discretise.nodes=1000
    test -s run/register/warped.nii.gz -a -s run/report/index.html
    dpkg --purge brainshift
    test ! -e /usr/bin/brainshift -a ! -e /usr/share/doc/brainshift'
  echo "The package installs, runs a phantom and leaves nothing behind."
fi
echo "Done: $out"
