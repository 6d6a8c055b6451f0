"""What the self-tests of the lints share: a rule is shown to fail on a made-up tree that breaks it alone."""
import os
import tempfile


def found_in(tree, violations):
    """What `violations`, a function of a folder, finds in a tree given as path -> text."""
    with tempfile.TemporaryDirectory() as root:
        for path, text in tree.items():
            os.makedirs(os.path.dirname(os.path.join(root, path)), exist_ok=True)
            with open(os.path.join(root, path), "w", encoding="utf-8") as file:
                file.write(text)
        return list(violations(root))


def wrong_answers(clean_tree, broken_files, violations):
    """A sentence for each wrong answer: the clean tree must pass, and each of `broken_files`, (path, text, piece of the
    sentence that must come out), must give exactly one finding."""
    wrong = [f"a clean tree is refused: {v}" for v in found_in(clean_tree, violations)]
    for path, text, sentence in broken_files:
        found = found_in({**clean_tree, path: text}, violations)
        if len(found) != 1 or not found[0].startswith(path + ":") or sentence not in found[0]:
            wrong.append(f"{path} with {text!r} must give one '{sentence}', gave {found}")
    return wrong
