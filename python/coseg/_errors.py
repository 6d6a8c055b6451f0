"""The exceptions of coseg, which carry the sentences of the program."""

from __future__ import annotations

import contextlib
import re
from typing import Iterator

from . import _core


class Error(Exception):
    """A failure of coseg: one sentence that names shape, face, file or option and says what to do.

    `code` is the exit code that the program would end with: 1 internal, 2 usage, 3 input, 4 output, 5 no
    convergence, 75 ended by a signal with its state written.
    """

    def __init__(self, sentence: str, code: int = 1):
        super().__init__(sentence)
        self.code = code


class UsageError(Error, ValueError):
    """An option or an argument that coseg does not take (code 2)."""

    def __init__(self, sentence: str, code: int = 2):
        super().__init__(sentence, code)


class InputError(Error, ValueError):
    """A mesh, labels or a matrix that cannot be used (code 3)."""

    def __init__(self, sentence: str, code: int = 3):
        super().__init__(sentence, code)


def _as_python_says_it(sentence: str) -> str:
    """The program's advice with the argument in place of its option, which Python does not take."""
    return re.sub(r"(?<![\w/-])--force(?![\w-])", "replace=True", sentence)


@contextlib.contextmanager
def translated() -> Iterator[None]:
    """Raises the failures of the extension as the exceptions of this module."""
    try:
        yield
    except _core.Failure as failure:
        code, sentence = failure.args
        raise {2: UsageError, 3: InputError}.get(code, Error)(_as_python_says_it(sentence), code) from None
