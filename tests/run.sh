#!/bin/bash
# SPDX-License-Identifier: GPL-3.0-or-later
#
# Every test, from a fresh Debian 12: installs what is missing, checks the format, builds, runs all tests of the release
# build, then the unit tests with the libraries under the address and undefined-behaviour sanitizers, and a minute of
# fuzzing.
#
#   bash tests/run.sh [--no-install]
set -euo pipefail
source "$(dirname "${BASH_SOURCE[0]}")/../pipelines/setup.sh"

case ${1:-} in
  '')
    install_packages clang-14 clang-format libbenchmark-dev libclang-rt-14-dev libomp-14-dev pybind11-dev python3 \
      python3-dev python3-matplotlib python3-nibabel python3-numpy python3-pydicom
    ;;
  --no-install) ;;
  *)
    echo "usage: bash tests/run.sh [--no-install]" >&2
    exit 2
    ;;
esac

# Tests run side by side, one thread each, where they do not ask for more: on the processors of the others its threads
# would wait for each other.
export OMP_WAIT_POLICY=passive OMP_NUM_THREADS=1

cd "$root"
git ls-files '*.cpp' '*.hpp' '*.cu' '*.cuh' | xargs clang-format --dry-run --Werror

# The GPU's part is compiled where its compiler is. Tests that want a GPU say that there is none; no code for a GPU is
# made then, only what its driver would make the code from, in three quarters of the time.
cuda=()
if [[ $(nvcc --version 2> /dev/null) =~ release\ 1[2-9] ]]; then
  architecture=90
  nvidia-smi > /dev/null 2>&1 || architecture=90-virtual
  cuda=(-DBRAINSHIFT_CUDA=ON -DBRAINSHIFT_CUDA_ARCHITECTURES=$architecture)
fi

developer=(-DBRAINSHIFT_TESTS=ON -DBRAINSHIFT_DEVELOPER=ON)
build build all "${developer[@]}" "${cuda[@]}" -DCMAKE_BUILD_TYPE=Release
ctest --test-dir build --output-on-failure --parallel "$(processors)"

# Clang compiles the sanitizers' checks in half of GCC's time, and warns of other things. The tests themselves are those
# of the release build.
build build-sanitize unit_tests "${developer[@]}" -DBRAINSHIFT_SANITIZE=ON -DBRAINSHIFT_FUZZ=ON \
  -DBRAINSHIFT_TEST_OBJECTS="$root/build" -DCMAKE_BUILD_TYPE=Debug -DCMAKE_CXX_FLAGS_DEBUG='-O1 -g1' \
  -DCMAKE_C_COMPILER=clang-14 -DCMAKE_CXX_COMPILER=clang++-14
LSAN_OPTIONS=suppressions=$root/tests/leaks.supp:print_suppressions=0 \
  ctest --test-dir build-sanitize --label-regex unit --output-on-failure --parallel "$(processors)"
