# Sourced by tools/demo, tools/test and tools/release: installs the Debian packages that the build, the programs, the tests
# and what is released need.
# Known: Debian 12 (bookworm), Debian 13 (trixie) and sid.

packages=(
    g++ cmake ninja-build ccache # the library is compiled once, also for the tests that build it otherwise
    libopenvdb-dev libtbb-dev libblosc-dev zlib1g-dev                          # volumes
    libboost-dev libboost-iostreams-dev
    libopenmesh-dev libcgal-dev libgmp-dev libmpfr-dev libqhull-dev            # surfaces
    libgl-dev libegl-dev libegl1 libgl1-mesa-dri libpng-dev                     # pictures, voxels by OpenGL
    libcli11-dev nlohmann-json3-dev libssl-dev                                 # the command
    libimgui-dev libglfw3-dev fonts-inter pkg-config                           # the window
    python3-dev python3-numpy pybind11-dev                                     # the Python module
)
quick_test_packages=(libboost-test-dev)
test_packages=(
    "${quick_test_packages[@]}"
    clang-format   # formatting is a test
    mandoc zsh fish # manual pages and completions
    doxygen        # the reference of the library, where every public name has a comment
    tetgen # fills cages, to see that others can use them
    xvfb xauth openbox xdotool # a display for the window, and a hand that uses it
    python3-jsonschema # reports keep to docs/user/report.schema.json
    python3-matplotlib # plots of the page of tools/bench/paper.py
    python3-mypy    # the types of the Python module
    python3-openvdb # files and arrays go between it and the Python module
    blender         # runs the add-on, and opens the volumes
    dpkg-dev fakeroot lintian mmdebstrap # packages, and a Debian without anything else to try them in
    python3-pip python3-setuptools python3-wheel python3-venv # the wheel of the Python module, and where it is tried
    parallel openssh-client openssh-server rsync slurm-wlm munge # farms, which run lists of jobs
)
release_packages=(
    binutils patchelf          # libraries: what they need, and where they find it
    python3-setuptools python3-wheel xz-utils zip
)

case $(. /etc/os-release 2>/dev/null && echo "${VERSION_CODENAME-}" || echo unknown) in # sets nothing for its caller
bookworm | trixie) test_packages+=(libosmesa6) ;; # draws without EGL; Mesa gave it up in 2025
forky | sid) test_packages+=(python3-cattr python3-requests) ;; # Blender 5.2 asks for them, its package does not
*) echo "This system is not known (Debian 12, 13 and sid are): names of packages may differ; INSTALL.md says what is needed." >&2 ;;
esac

# missing_packages NAME...: prints those that are not installed.
missing_packages() {
    local name
    for name in "$@"; do
        dpkg-query -W -f='${Status}' "$name" 2>/dev/null | grep -q 'ok installed' || echo "$name"
    done
}

# install_packages NAME...: by apt-get, as root or through sudo; silent and quick when nothing is missing.
install_packages() {
    local missing
    mapfile -t missing < <(missing_packages "$@")
    [ ${#missing[@]} -eq 0 ] && return 0
    if ! command -v apt-get >/dev/null; then
        echo "There is no apt-get here to install: ${missing[*]}" >&2
        return 1
    fi
    local root=()
    if [ "$(id -u)" -ne 0 ]; then
        if ! command -v sudo >/dev/null; then
            echo "These packages are missing and neither root rights nor sudo are here to install them:" >&2
            echo "  apt-get install ${missing[*]}" >&2
            return 1
        fi
        root=(sudo)
    fi
    echo "Installing: ${missing[*]}"
    "${root[@]}" apt-get update -qq
    "${root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "${missing[@]}" >/dev/null
}
