#!/usr/bin/env python3
"""A disk that fills up while coseg edit serves a run on it: an act is refused in a sentence, and nothing is lost.

usage: edit_full_disk.py COSEG RUN     the run is on a small disk, which is filled and freed again
"""
import os
import sys

from edit_client import Server


def fill(path):
    """Writes zeros until there is no room for a page more."""
    with open(path, "wb", buffering=0) as file:
        try:
            while True:
                file.write(bytes(4096))
        except OSError:
            return


def check(server, run):
    server.state()
    labels = server.labels(0)[0]
    server.post(f"label/0?face=0&region=piece&part={1 - labels[0]}")
    painted, other = server.labels(0)[0], server.labels(1)[0]
    assert painted != labels
    with open(f"{run}/corrections.json", encoding="utf-8") as file:
        kept = file.read()
    filler = f"{run}/filler"
    fill(filler)
    part = 1 - other[0]
    refused = server.post(f"label/1?face=0&region=piece&part={part}", expect=507)["error"]
    assert "corrections.json" in refused and "No space left on device" in refused, refused
    assert server.labels(0)[0] == painted and server.labels(1)[0] == other, "an act that was refused"
    with open(f"{run}/corrections.json", encoding="utf-8") as file:
        assert file.read() == kept
    os.remove(filler)
    server.post(f"label/1?face=0&region=piece&part={part}")
    assert server.labels(1)[0][0] == part, "the same act once there is room"
    server.end()


def main():
    coseg, run = sys.argv[1:3]
    server = Server(coseg, run)
    try:
        check(server, run)
    finally:
        server.process.kill()


if __name__ == "__main__":
    main()
