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

[ $install = no ] || install_packages help2man lintian dpkg-dev fakeroot mmdebstrap pybind11-dev python3-dev
mkdir -p "$out"
build "$root/build" brainshift -DCMAKE_BUILD_TYPE=Release -DBRAINSHIFT_PYTHON=ON
cmake --build "$root/build" --target man_pages brainshift_python

(cd "$root" && git archive --prefix=brainshift/ --output="$out/brainshift-source.tar.gz" HEAD)
cpack --config "$root/build/CPackConfig.cmake" -G DEB -B "$out"
package=$(ls -t "$out"/brainshift_*.deb | head -n 1)
module=$(ls -t "$out"/python3-brainshift_*.deb | head -n 1)
echo "Checking $package and $module"
lintian --fail-on error "$package" "$module"

if [ $try = yes ]; then
  chroot=$(mktemp -d)
  trap 'rm -rf "$chroot"' EXIT
  depends=$(for file in "$package" "$module"; do dpkg-deb --field "$file" Depends; done | paste -sd, |
    sed 's/([^)]*)//g; s/|[^,]*//g; s/ //g')
  mmdebstrap --variant=minbase --include="$depends" bookworm "$chroot"
  cp "$package" "$chroot/tmp/brainshift.deb"
  cp "$module" "$chroot/tmp/module.deb"
  chroot "$chroot" dpkg -i /tmp/brainshift.deb /tmp/module.deb
  chroot "$chroot" sh -ec 'cd /tmp
    brainshift --version
    brainshift phantom --size 48 --out head
    brainshift run head/scene.xml --out run --set discretise.nodes=1000
    test -s run/register/warped.nii.gz -a -s run/report/index.html
    python3 -c "import brainshift; print(brainshift.segment(brainshift.read_label_map(\"head/labels.nii.gz\")).brain)"
    dpkg --purge python3-brainshift brainshift
    test ! -e /usr/bin/brainshift -a ! -e /usr/libexec/brainshift -a ! -e /usr/share/doc/brainshift
    test ! -e /usr/lib/python3/dist-packages/brainshift'
  echo "The packages install, run a phantom and leave nothing behind."
fi
echo "Done: $out"
