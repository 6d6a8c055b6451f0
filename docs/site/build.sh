#!/usr/bin/env bash
# docs/site/build.sh OUT : the documents, the C++ interface and the Python module as a site, OUT/html/index.html. Needs doxygen.
set -euo pipefail
out=$(realpath -m "$1")
mkdir -p "$out"
cd "$(dirname "${BASH_SOURCE[0]}")/../.."
{
    cat docs/site/Doxyfile
    echo "OUTPUT_DIRECTORY = \"$out\""
} | doxygen -
# What the documents link to beside themselves.
mkdir -p "$out/html/python"
cp -r examples "$out/html/"
cp -r examples "$out/"
cp -r python/examples "$out/html/python/"
