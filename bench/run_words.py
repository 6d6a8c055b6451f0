"""Splits the words of a benchmark from the options of `coseg run` that stand behind `--`."""
import sys


def parsed_with_options(parser):
    """The arguments of the command line, and the words behind `--`."""
    words = sys.argv[1:]
    split = words.index("--") if "--" in words else len(words)
    return parser.parse_args(words[:split]), words[split + 1:]
