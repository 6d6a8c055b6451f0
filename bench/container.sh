#!/usr/bin/env bash
# Builds the Containerfile as README.md says, and runs the program and the Python module in the container. The base image
# debian:bookworm-slim is made by debootstrap, so that no registry of images is needed. Says what each step takes. Needs root,
# buildah and debootstrap (packages of Debian), the network, 8 GB of disk in TMPDIR and some half an hour on two cores.
#
#   bench/container.sh [MIRROR]
set -euo pipefail

project=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
mirror=${1:-http://deb.debian.org/debian}
((EUID == 0)) || { echo "error: debootstrap is for root" >&2; exit 2; }
for program in buildah debootstrap; do
    command -v "$program" >/dev/null || { echo "error: there is no $program; apt-get install $program" >&2; exit 2; }
done
work=$(mktemp -d)
trap 'rm -rf --one-file-system "$work"' EXIT
# Images and containers of this script alone, with all of a container in one chroot, which needs no other service.
images() { buildah --root "$work/images" --runroot "$work/run" --storage-driver vfs "$@"; }
begin=0
step() { # step WHAT COMMAND...
    begin=$SECONDS
    "${@:2}" >"$work/log" 2>&1 || { tail -n 20 "$work/log" >&2; echo "error: $1" >&2; exit 1; }
    printf '%-34s %5d s\n' "$1" $((SECONDS - begin))
}

base_image() {
    debootstrap --variant=minbase bookworm "$work/root" "$mirror"
    local container
    container=$(images from scratch)
    images add "$container" "$work/root" /
    images config --cmd bash "$container"
    images commit --rm "$container" docker.io/library/debian:bookworm-slim
    rm -rf --one-file-system "$work/root"
}
build_image() { images build --isolation chroot --network host --pull-never --tag coseg "$project"; }
inside() { images run --isolation chroot --network host --volume "$work/data:/data" "$container" -- "$@"; }

mkdir "$work/data"
step "debian:bookworm-slim" base_image
step "podman build -t coseg ." build_image
container=$(images from --pull-never localhost/coseg)
step "coseg generate" inside coseg generate chair --count 4 --faces 2000 --out /data/chairs
step "coseg run on 2 ranks" inside mpirun -n 2 coseg run --parts 4 --out /data/result /data/chairs/meshes
step "the Python module" inside python3 -c "import coseg; print(len(coseg.segment([(s.vertices, s.faces) for s in coseg.generate('table', 4)], 2).labels))"
echo "$(find "$work/data/result/labels" -name '*.seg' | wc -l) label files of $(find "$work/data/chairs/meshes" -type f | wc -l) meshes"
images images
