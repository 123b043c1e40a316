# Runs as root in a Debian that holds /input only: installs the packages, uses them, and removes them.
set -eux
export DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8
cd /input
library=$(basename libvdbcage[0-9]*.deb | cut -d_ -f1)
ours="$library vdbcage python3-vdbcage"
# All but what dpkg, apt and ldconfig write themselves.
files() { find / -xdev \( -path /proc -o -path /sys -o -path /dev -o -path /input -o -path /tmp -o -path /var/lib/dpkg \
    -o -path /var/lib/apt -o -path /var/cache -o -path /var/log \) -prune -o -print | sort; }
# needs FILE.deb...: what the packages depend on, but for each other.
needs() { for deb; do dpkg-deb -f "$deb" Depends; done | tr -s ',\n' '\n\n' | grep -v vdbcage | paste -sd,; }
satisfy() { apt-get satisfy -y -q --no-install-recommends "$(needs "$@")"; }

# What the packages say they need is enough for them: dpkg installs nothing else.
satisfy "$library"_*.deb vdbcage_*.deb python3-vdbcage_*.deb
files > /tmp/before_use
dpkg -i "$library"_*.deb vdbcage_*.deb python3-vdbcage_*.deb
vdbcage make bishop.obj -o /tmp/cage.obj --faces 200
vdbcage check /tmp/cage.obj bishop.obj
vdbcage-view --help > /tmp/help
for page in vdbcage vdbcage-make vdbcage-view; do gunzip -c /usr/share/man/man1/$page.1.gz | grep -q '^.SH SYNOPSIS'; done
bash -c '. /usr/share/bash-completion/completions/vdbcage; complete -p vdbcage'
test -s /usr/share/zsh/vendor-completions/_vdbcage -a -s /usr/share/fish/vendor_completions.d/vdbcage.fish
test -s /usr/share/doc/vdbcage/docs/OPTIONS.md
python3 -c "
import vdbcage
assert vdbcage.__file__ == '/usr/lib/python3/dist-packages/vdbcage/__init__.py', vdbcage.__file__
assert vdbcage.make_cage(vdbcage.Mesh.read('bishop.obj'), faces=100).check.bounding
"

# Programs of others are built against the development package, with what it says it needs and a compiler.
dpkg --purge $ours
files > /tmp/after_use
diff /tmp/before_use /tmp/after_use
apt-get install -y -q --no-install-recommends g++ cmake make pkg-config
satisfy "$library"_*.deb libvdbcage-dev_*.deb
files > /tmp/before_development
dpkg -i "$library"_*.deb libvdbcage-dev_*.deb
cmake -S examples -B /tmp/examples -DCMAKE_BUILD_TYPE=Release
cmake --build /tmp/examples --target example_cage
/tmp/examples/example_cage bishop.obj /tmp/cage.obj
g++ examples/cage.cpp -o /tmp/by_pkg_config $(pkg-config --cflags --libs vdbcage)
/tmp/by_pkg_config bishop.obj /tmp/cage.obj

dpkg --purge libvdbcage-dev $library
files > /tmp/after_development
diff /tmp/before_development /tmp/after_development
[ -z "$(dpkg-query -W -f '${Package}\n' '*vdbcage*' 2>/dev/null)" ]
