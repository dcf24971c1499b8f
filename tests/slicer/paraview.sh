#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Runs open_in_paraview.py of a phantom's run by Debian's ParaView, and leaves its picture as DIR/picture.png. ParaView
# is unpacked, not installed: its Python and VTK's development files, which the build needs, exclude each other.
#
#   bash tests/slicer/paraview.sh [--out DIR] [--no-install]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../../pipelines/setup.sh"

out=$root/build/paraview install=yes
while [ $# -gt 0 ]; do
  case $1 in
    --out) out=$2; shift ;;
    --no-install) install=no ;;
    *) sed -n '/^#   bash/s/^#   /usage: /p' "$0" >&2; exit 2 ;;
  esac
  shift
done
[ $install = no ] || install_packages python3 xvfb xauth
if [ ! -x "$out/root/usr/bin/pvbatch" ]; then
  mkdir -p "$out"
  (cd "$out" && apt-get download --quiet paraview python3-paraview)
  for package in "$out"/*paraview_*.deb; do dpkg-deb --extract "$package" "$out/root"; done
fi
program=${BRAINSHIFT:-$(built_program)}
out=$(realpath "$out")
# Around pvbatch alone: what else is called here finds its own libraries.
mkdir -p "$out/bin"
cat > "$out/bin/pvbatch" << end
#!/bin/sh
LD_LIBRARY_PATH="$out/root/usr/lib/x86_64-linux-gnu" exec "$out/root/usr/bin/pvbatch" "\$@"
end
chmod +x "$out/bin/pvbatch"
PATH=$out/bin:$PATH PYTHONPATH=$out/root/usr/lib/python3/dist-packages BRAINSHIFT_PICTURE=$out/picture.png \
  /usr/bin/python3 "$root/tests/slicer/show_test.py" "$program" "$root/build/share/brainshift/slicer" InParaView
echo "ParaView's picture: $out/picture.png"
