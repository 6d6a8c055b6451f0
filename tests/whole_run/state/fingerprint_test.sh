#!/usr/bin/env bash
# What of a state folder a changed source throws away: the fingerprints of a copy of the sources, before and after a change.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

for folder in src io solvers mpi_drivers; do cp -r "$COSEG_SOURCE/$folder" "$work/"; done
script=$work/mpi_drivers/process/fingerprint.cmake

# fingerprints [SETTINGS] : a line for each piece.
fingerprints() {
    cmake -DROOT="$work" -DSETTINGS="${1:-release}" -DOUTPUT="$work/made.cpp" -P "$script"
    sed -n 's/ *case KeptPiece::\([a-z]*\):.*/\1/p; s/ *return "\(.\+\)";/\1/p' "$work/made.cpp" | paste -d' ' - -
}
# changes WHAT PIECE... : exactly these pieces have another fingerprint than at first; the sources are then put back.
changes() {
    local what=$1 changed
    shift
    fingerprints >"$work/second"
    changed=$({ diff "$work/second" "$work/first" || true; } | sed -n 's/^< \([a-z]*\) .*/\1/p' | paste -sd' ')
    [[ $changed == "$*" ]] || fail "$what: changes '$changed', not '$*'"
    for folder in src io solvers mpi_drivers; do cp -r "$COSEG_SOURCE/$folder" "$work/"; done
    echo "ok: $what"
}

fingerprints >"$work/first"
[[ $(cut -d' ' -f1 "$work/first" | paste -sd' ') == "descriptions solutions cuts features" ]] || fail "$(cat "$work/first")"
[[ $(cut -d' ' -f2 "$work/first" | sort -u | wc -l) -eq 4 ]] || fail "two pieces with one fingerprint"

while read -r file; do
    sed -i -e '1i // A comment with "quotes" in it.' -e 's/;$/; \/* and one *\/  /' -e 's/^    /\t/' "$file"
done < <(find "$work"/{src,io,solvers,mpi_drivers} -name '*.?pp')
changes "comments and white space everywhere"

more() { echo 'int one_more() { return 1; }' >>"$work/$1"; }
for file in src/pictures/*.cpp io/reports/*.cpp mpi_drivers/commands/*.cpp mpi_drivers/process/*.cpp solvers/boundaries/fuzzy_cut.cpp; do
    for changed in "$work"/$file; do more "${changed#"$work"/}"; done
done
changes "pictures, reports, commands, the process, boundaries of faces"
more solvers/boundaries/minimum_cut.cpp
changes "minimum cuts, by which parts expand" cuts
more src/descriptors/shape_diameter.cpp
changes "a descriptor" descriptions features
more io/mesh_files/mesh_reader.cpp
changes "the reader of meshes" descriptions features
more src/histograms/histogram.hpp
changes "a header of the histograms" features
more solvers/choice/partition_terms.cpp
changes "the choice of the partition" cuts
more src/records/start_outcome.hpp
changes "the record of a start" cuts
more solvers/row_scope/row_prox.cpp
changes "a part of the optimiser" solutions
more src/base/error.hpp
changes "errors" descriptions solutions cuts features
sed -i 's|not a finite|not one finite|' "$work/solvers/subspace/subspace_problem.cpp"
changes "a text" solutions
fingerprints other >"$work/other"
[[ $({ diff "$work/other" "$work/first" || true; } | grep -c "^<") -eq 4 ]] || fail "the settings of the build change nothing"
echo "ok: settings of the build"
