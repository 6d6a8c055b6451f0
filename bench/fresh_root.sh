#!/usr/bin/env bash
# Installs the packages that cpack makes in a fresh Debian 12, and runs the example notebook there, as a user would. Says what each
# step takes. Needs root, debootstrap (a package of Debian), the network, 3 GB of disk in TMPDIR and some ten minutes.
#
#   bench/fresh_root.sh BUILD [MIRROR]     BUILD is a finished build with the Python module
set -euo pipefail

say() { printf '%-34s %5d s, %5d MB\n' "$1" $((SECONDS - begin)) "$(du -sm --one-file-system "$2" | cut -f1)"; }

if [[ ${1:-} == --inside ]]; then # in a namespace of its own, whose mounts end with it
    root=$2
    mount -t proc proc "$root/proc"
    mount --rbind /sys "$root/sys"
    mount --rbind /dev "$root/dev"
    inside() { chroot "$root" env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 DEBIAN_FRONTEND=noninteractive "$@"; }
    begin=$SECONDS
    inside apt-get update -q >"$root/root/log"
    inside bash -c 'cd /root && apt-get install -y -q ./coseg_*.deb ./python3-coseg_*.deb jupyter-nbconvert python3-ipykernel' \
        >>"$root/root/log" 2>&1 </dev/null || { tail "$root/root/log"; exit 1; }
    say "the packages and what they need" "$root"
    begin=$SECONDS
    inside bash -c 'cd /root && cp /usr/share/doc/python3-coseg/examples/segment_generated.ipynb . &&
        jupyter nbconvert --to notebook --execute --output shown.ipynb segment_generated.ipynb' >>"$root/root/log" 2>&1 ||
        { tail "$root/root/log"; exit 1; }
    say "the notebook" "$root"
    exit 0
fi

build=${1:?usage: bench/fresh_root.sh BUILD [MIRROR]}
mirror=${2:-http://deb.debian.org/debian}
((EUID == 0)) || { echo "error: debootstrap and chroot are for root" >&2; exit 2; }
command -v debootstrap >/dev/null || { echo "error: there is no debootstrap; apt-get install debootstrap" >&2; exit 2; }
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
cpack --config "$build/CPackConfig.cmake" -G DEB -B "$work/packages" >"$work/log" 2>&1 || { tail "$work/log"; exit 1; }
begin=$SECONDS
debootstrap --variant=minbase bookworm "$work/root" "$mirror" >"$work/log" 2>&1 || { tail "$work/log"; exit 1; }
say "a fresh Debian 12" "$work/root"
cp "$work"/packages/coseg_*.deb "$work"/packages/python3-coseg_*.deb "$work/root/root"
cp /etc/resolv.conf "$work/root/etc/resolv.conf"
unshare --mount bash "$0" --inside "$work/root"
python3 - "$work/root/root/shown.ipynb" <<'END'
import json, sys
cells = [cell for cell in json.load(open(sys.argv[1]))["cells"] if cell["cell_type"] == "code"]
shown = [output["data"] for cell in cells for output in cell["outputs"] if "data" in output]
assert "12 shapes" in "".join(shown[0]["text/plain"]), shown[0]
assert "image/png" in shown[1], "no inline picture, but " + str(list(shown[1]))
lines = sum(len("".join(cell["source"]).strip().splitlines()) for cell in cells[:2])
print(f"{''.join(shown[0]['text/plain'])} and an inline picture of {len(shown[1]['image/png']) * 3 // 4} bytes in {lines} lines")
END
