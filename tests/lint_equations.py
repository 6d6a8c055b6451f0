#!/usr/bin/env python3
"""Checks the table of docs/method.md that says where each equation of the paper is: files and functions are there.

usage: lint_equations.py SOURCE_DIR   prints each row that is wrong as a sentence; exit code 1 if there is any
       lint_equations.py --self-test  shows on made-up tables that a wrong row is found, and a right one passes
"""
import os
import re
import sys
import tempfile

HEADING = "## Where the equations are"
ROW = re.compile(r"^\| .* \| `([^`]+)` \| `([^`]+)` \|$")
# What a reader of the paper looks for: the table must name a place for each.
WANTED = ("equation (4)", "equation (5)", "equations (6) and (7)", "equation (8)", "minima rule", "fuzzy cuts",
          "words", "normalised cut", "discretisation", "choice", "over-segmentation", "histograms")


def violations(root):
    """Sentences about what is wrong with the table."""
    with open(os.path.join(root, "docs/method.md"), encoding="utf-8") as page:
        text = page.read()
    if HEADING not in text:
        return [f"docs/method.md: has no section '{HEADING}'"]
    section = text.split(HEADING, 1)[1].split("\n## ", 1)[0]
    found = [f"docs/method.md: the table names no place for '{wanted}'" for wanted in WANTED if wanted not in section]
    for line in section.splitlines():
        if not line.startswith("|") or line.startswith("| ---") or "`" not in line:
            continue
        row = ROW.match(line)
        if not row:
            found.append(f"docs/method.md: '{line}' is not of the form | what | `file` | `function` |")
            continue
        path, name = row.groups()
        if not os.path.isfile(os.path.join(root, path)):
            found.append(f"docs/method.md: {path} is not there")
            continue
        with open(os.path.join(root, path), encoding="utf-8") as source:
            code = re.sub(r"//[^\n]*", "", source.read())
        # Definitions begin at the margin with their type; calls are indented.
        if not re.search(rf"^(?:[A-Za-z_][\w:<>,&* ]* )?[&*]?{re.escape(name)}(?:\(| \{{)", code, re.MULTILINE):
            found.append(f"docs/method.md: {path} defines no {name}")
    return found


def self_test():
    with tempfile.TemporaryDirectory() as root:
        os.makedirs(os.path.join(root, "docs"))
        os.makedirs(os.path.join(root, "src"))
        with open(os.path.join(root, "src/a.cpp"), "w", encoding="utf-8") as source:
            source.write("// void gone();\nnamespace x {\nstd::vector<int> there(int i) {\n    return called(i);\n}\n}\n")
        rows = "".join(f"| {wanted} | `src/a.cpp` | `there` |\n" for wanted in WANTED)

        def sentences(extra, table=rows):
            with open(os.path.join(root, "docs/method.md"), "w", encoding="utf-8") as page:
                page.write(f"# Method\n\n{HEADING}\n\n| of the paper | file | function |\n| --- | --- | --- |\n{table}{extra}")
            return violations(root)
        assert sentences("") == [], sentences("")
        for wrong in ("| x | `src/b.cpp` | `there` |\n", "| x | `src/a.cpp` | `gone` |\n",
                      "| x | `src/a.cpp` | `called` |\n", "| x | `src/a.cpp` there |\n"):
            assert len(sentences(wrong)) == 1, (wrong, sentences(wrong))
        assert len(sentences("", rows.split("\n", 1)[1])) == 1
    print("ok: every rule can fail")
    return 0


def main(arguments):
    if arguments == ["--self-test"]:
        return self_test()
    if len(arguments) != 1:
        print(__doc__, file=sys.stderr)
        return 2
    sentences = violations(arguments[0])
    for sentence in sentences:
        print(sentence)
    return 1 if sentences else 0


if __name__ == "__main__":
    sys.exit(main(sys.argv[1:]))
