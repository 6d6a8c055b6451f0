#!/usr/bin/env bash
# The site of the documents is made without warnings, its links lead somewhere, and it shows both interfaces. Skipped without doxygen.
set -euo pipefail
# shellcheck source=tests/whole_run/fixture.sh
source "$(dirname "${BASH_SOURCE[0]}")/../fixture.sh"

if ! command -v doxygen >/dev/null; then
    echo "skipped: doxygen is not installed"
    exit 0
fi
"$COSEG_SOURCE/docs/site/build.sh" "$work/site" >"$work/log" 2>&1 || fail "the site is not made: $(tail -3 "$work/log")"
[[ ! -s $work/log ]] || fail "warnings: $(head -5 "$work/log")"
python3 - "$work/site/html" "$COSEG_SOURCE/docs" <<'END' || fail "the pages of the site"
import html, os, re, sys
site, docs = sys.argv[1:]
pages = {name: open(os.path.join(site, name), encoding="utf-8").read() for name in os.listdir(site) if name.endswith(".html")}
broken = sorted({(name, link) for name, text in pages.items() for link in re.findall(r'href="([^"#?]+)', text)
                 if not re.match(r"[a-z]+:", link) and not os.path.exists(os.path.join(site, html.unescape(link)))})
assert not broken, broken[:5]
titles = {re.search(r"<title>(.*?)</title>", text).group(1).split(": ", 1)[-1] for text in pages.values()}
for document in os.listdir(docs):
    if document.endswith(".md"):
        title = open(os.path.join(docs, document)).readline().lstrip("# ").strip()
        assert html.escape(title, quote=False) in titles or title in titles, (document, sorted(titles))
cpp, python = (pages[name] for name in ("namespacecoseg_1_1interface__1.html", "namespacecoseg_1_1__segmentation.html"))
assert "SegmentOptions" in cpp and "load_mesh" in cpp, "the C++ interface"
assert "segment" in python and "assign" in python, "the Python module"
assert "fit_predict" in pages["classcoseg_1_1__clusters_1_1SubspaceClustering.html"]
END
echo "ok: site"
