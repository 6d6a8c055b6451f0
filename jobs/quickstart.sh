#!/usr/bin/env bash
# From a fresh clone to a co-segmented collection: installs what is missing, builds the program, makes a small
# collection with known parts, segments it on two ranks, scores it, and says where to look.
#
#   ./jobs/quickstart.sh
#
# The build folder is build/, shared with tests/run.sh; the results go to quickstart/.
set -euo pipefail
if (($# > 0)); then
    sed -n '2,/^set /{/^#/s/^# \{0,1\}//p}' "${BASH_SOURCE[0]}"
    if [[ $1 == --help || $1 == -h ]]; then exit 0; fi
    echo "error: it takes no arguments" >&2
    exit 2
fi
# shellcheck source=jobs/build_steps.sh
source "$(dirname "${BASH_SOURCE[0]}")/build_steps.sh"

family=goblet
shapes=12
parts=3
faces=4000
seed=1
coseg=$build/bin/coseg

mkdir -p "$build"
install_missing "$build/install.log" "${coseg_packages[@]}"
# The tests need more packages; tests/run.sh turns them on in the same folder.
is_configured || configure -DCOSEG_BUILD_TESTS=OFF
[[ -x $coseg ]] || echo "building the program in $build (a few minutes the first time)"
build_target coseg

cd "$root"
mkdir -p quickstart
logged quickstart/generate.log \
    mpirun -n 2 "$coseg" generate "$family" --count "$shapes" --seed "$seed" --faces "$faces" --out quickstart --force
echo "segmenting $shapes generated shapes into $parts parts on 2 ranks"
logged quickstart/run.log \
    mpirun -n 2 "$coseg" run --parts "$parts" --out quickstart/result --force quickstart/meshes
"$coseg" score --truth quickstart/truth --labels quickstart/result/labels quickstart/meshes >quickstart/score.txt

cat <<END

quickstart/meshes              $shapes shapes of the family '$family' with known parts in quickstart/truth
quickstart/result/report.html   the run as a page: open it in a browser
quickstart/result/contact_sheet.png  a picture of all of them, coloured by part
quickstart/result/ply          the same shapes coloured by part: open them in MeshLab, Blender or ParaView
quickstart/result/labels       the part of every face, one number a line
quickstart/result/report.json  options, times and figures of the run
quickstart/score.txt           agreement with the known parts, shape by shape:
$(sed -n '1p; /^mean of/p' quickstart/score.txt | sed 's/^/    /')

Your own meshes:  mpirun -n 2 build/bin/coseg run --parts $parts --out DIR FOLDER_OF_MESHES
END
