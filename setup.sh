#!/usr/bin/env bash
# Installs the Debian 12 packages that Kreisel builds and runs with; skips what is there, and uses sudo only when
# not root.   ./setup.sh          what is needed to build, run, test and plot
#             ./setup.sh --python and what the Python library is built with
#             ./setup.sh --live   and what `design live` is built with
#             ./setup.sh --ci     and what only CI needs, too (formatting, a slicer, a browser, notebooks, Slurm)
set -euo pipefail

packages=(
  g++ cmake ninja-build git pkg-config                                # build
  opencl-clhpp-headers ocl-icd-opencl-dev pocl-opencl-icd             # OpenCL and its CPU device
  libeigen3-dev libfmt-dev libcli11-dev libtomlplusplus-dev nlohmann-json3-dev
  libembree-dev libhdf5-dev
  libgmp-dev                                                          # exact points where surfaces cross
  libmuparser-dev                                                     # arithmetic in columns of tables
  libarchive-dev                                                      # packs and unpacks 3MF packages, and the real meshes
  libexpat1-dev                                                       # XML of 3MF packages
  zlib1g-dev                                                          # compresses what a page holds
  coinor-libipopt-dev libopenblas0-pthread                            # Ipopt with MUMPS; OpenBLAS speeds MUMPS up
  libnlopt-dev                                                        # SLSQP, for small octrees
  libpagmo-dev                                                        # swarms to compare ours with
  libopenvdb-dev                                                      # offset surfaces
  libgtest-dev libbenchmark-dev
  libcgal-demo                                                        # real meshes (18 MB) for tests and experiments; data only
  python3-h5py python3-matplotlib                                     # plots and the records' tests
  libjs-three                                                         # the pages of `design --html`
  admesh libcgal-dev                                                  # look at written meshes, in tests alone
)
python=(pybind11-dev python3-dev)
live=(libboost-dev)                                                   # HTTP and WebSockets: Boost.Beast
ci=(clang-format prusa-slicer chromium                                # slicer and browser: 800 MB, for two tests
    python3-nbconvert python3-ipykernel
    groff-base                                                        # reads the programs' pages, for one test
    slurmctld slurmd slurm-client munge)                              # a cluster of two virtual nodes, for one test
case "${1:-}" in
  "") ;;
  --python) packages+=("${python[@]}") ;;
  --live) packages+=("${live[@]}") ;;
  --ci) packages+=("${python[@]}" "${live[@]}" "${ci[@]}") ;;
  *) echo "setup.sh: unknown option '$1'; expected --python, --live, --ci or nothing" >&2; exit 2 ;;
esac

missing=()
for package in "${packages[@]}"; do
  [ "$(dpkg-query -W -f='${Status}' "$package" 2>/dev/null)" = "install ok installed" ] || missing+=("$package")
done
if [ ${#missing[@]} -eq 0 ]; then
  exit 0
fi

as_root=()
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || { echo "setup.sh: needs root or sudo to install: ${missing[*]}" >&2; exit 1; }
  as_root=(sudo)
fi
echo "setup.sh: installing ${missing[*]}"
"${as_root[@]}" apt-get update -qq
DEBIAN_FRONTEND=noninteractive "${as_root[@]}" apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
