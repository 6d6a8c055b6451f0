#!/usr/bin/env bash
# Submits the co-segmentation of a collection to Slurm: one job for up to 200 meshes; for more an array that describes them,
# 500 meshes a shard, and a job after it that solves. Interrupted jobs go back into the queue and continue.
#
#   ./jobs/submit.sh COLLECTION K [--dry-run] [--out DIR] [--state DIR] [--ntasks N] [--time LIMIT] [-- OPTION OF coseg run ...]
#
# COLLECTION is a folder of meshes or @LIST, K a number. --dry-run prints the commands instead. Defaults: OUT = COLLECTION-K, STATE = coseg-state,
# 16 ranks, 4 hours. Exports COSEG_HOME (this project) and, if set, COSEG (the program) to the jobs.
set -euo pipefail

usage() {
    sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}" >&2
    exit 2
}

small_collection=200 # meshes up to which one job does it all
meshes_per_shard=500
most_shards=64

dry_run=
out=
state=coseg-state
tasks=16
limit=4:00:00
words=()
options=()
while (($# > 0)); do
    case $1 in
        --dry-run) dry_run=1 ;;
        --out | --state | --ntasks | --time)
            (($# > 1)) || usage
            case $1 in
                --out) out=$2 ;;
                --state) state=$2 ;;
                --ntasks) tasks=$2 ;;
                --time) limit=$2 ;;
            esac
            shift
            ;;
        --)
            shift
            options=("$@")
            break
            ;;
        -*) usage ;;
        *) words+=("$1") ;;
    esac
    shift
done
((${#words[@]} == 2)) || usage
collection=${words[0]}
parts=${words[1]}
[[ $parts =~ ^[1-9][0-9]*$ ]] || { echo "error: K must be a positive number, not '$parts'" >&2; exit 2; }

# meshes_in FOLDER : how many meshes it holds.
meshes_in() { find -L "$1" -maxdepth 1 -type f -iregex '.*\.\(off\|obj\|ply\|stl\|glb\|gltf\|vtp\)' | wc -l; }

if [[ $collection == @* ]]; then
    [[ -f ${collection#@} && -r ${collection#@} ]] || { echo "error: ${collection#@} is no list that can be read" >&2; exit 3; }
    count=0
    folder=$(dirname "${collection#@}")
    while IFS= read -r line || [[ -n $line ]]; do
        [[ $line =~ ^[[:space:]]*[^#[:space:]] ]] || continue
        path=$folder/$line
        [[ $line != /* ]] || path=$line
        if [[ -d $path ]]; then count=$((count + $(meshes_in "$path"))); else count=$((count + 1)); fi
    done <"${collection#@}"
    name=$(basename "${collection#@}")
    name=${name%.*}
    collection=@$(realpath "${collection#@}")
else
    [[ -d $collection ]] || { echo "error: $collection is no folder; name a folder of meshes or @LIST" >&2; exit 3; }
    count=$(meshes_in "$collection")
    name=$(basename "$(realpath "$collection")")
    collection=$(realpath "$collection")
fi
((count > 0)) || { echo "error: $collection holds no meshes" >&2; exit 3; }
out=$(realpath -m "${out:-$name-$parts}")
state=$(realpath -m "$state")

COSEG_HOME=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
export COSEG_HOME
common=(--parsable --ntasks="$tasks" --time="$limit" --export=ALL)
run=(--parts "$parts" --state "$state" --out "$out" --force "$collection" "${options[@]}")

# submit ARGUMENT... : sbatch, or what it would be; prints the job's number.
submit() {
    if [[ -n $dry_run ]]; then
        printf 'sbatch' >&2
        printf ' %q' "$@" >&2
        printf '\n' >&2
        echo JOB
    else
        sbatch "$@"
    fi
}

# options_of_descriptions : sets `describe` to those of the run's options that coseg describe has too, with their values. Shapes that
# were described with others would be described again by the run.
options_of_descriptions() {
    local program=${COSEG:-$COSEG_HOME/build/bin/coseg} word known kept=
    describe=()
    ((${#options[@]} > 0)) || return 0
    known=$("$program" describe --help | grep -oE -- '--[a-z-]+') || { echo "error: $program is no program; build coseg, or say where it is with COSEG=PATH" >&2; exit 2; }
    for word in "${options[@]}"; do
        [[ $word != -- ]] || break
        if [[ $word == --* ]]; then
            kept=
            if grep -qxF -- "${word%%=*}" <<<"$known"; then kept=1; fi
        fi
        [[ -z $kept ]] || describe+=("$word")
    done
}

if ((count <= small_collection)); then
    job=$(submit "${common[@]}" "$COSEG_HOME/jobs/coseg.sbatch" run "${run[@]}")
    echo "job $job: $count meshes into $parts parts, results in $out"
else
    shards=$(((count + meshes_per_shard - 1) / meshes_per_shard))
    ((shards <= most_shards)) || shards=$most_shards
    options_of_descriptions
    array=$(submit "${common[@]}" --array=0-$((shards - 1)) "$COSEG_HOME/jobs/descriptors.sbatch" --state "$state" "$collection" "${describe[@]}")
    job=$(submit "${common[@]}" --dependency="afterok:${array%%;*}" "$COSEG_HOME/jobs/solve.sbatch" "${run[@]}")
    echo "array $array: $count meshes in $shards shards; then job $job: $parts parts, results in $out"
fi
