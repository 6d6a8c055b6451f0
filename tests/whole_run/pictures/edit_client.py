#!/usr/bin/env python3
"""Uses coseg edit as a page does, by HTTP, and checks what follows.

usage: edit_client.py COSEG RUN [RANKS]     acts on the run, leaves RUN/corrections.json and RUN/corrected, ends the server
"""
import json
import os
import signal
import subprocess
import sys
import time
import urllib.error
import urllib.request


class Server:
    """A server started for a run, on RANKS ranks."""

    def __init__(self, coseg, run, ranks=1, options=()):
        launch = ["mpirun", "--oversubscribe", "-n", str(ranks)] if ranks > 1 else []
        self.process = subprocess.Popen(launch + [coseg, "edit", run, "--quiet", *options], stdout=subprocess.PIPE, text=True)
        self.address = self.process.stdout.readline().strip()
        assert self.address.startswith("http://127.0.0.1:"), self.address
        self.revision = None

    def ask(self, path, body=None, method=None, headers=None, address=None):
        """The status and the reply, as JSON where it is that."""
        data = None if body is None else (body if isinstance(body, bytes) else json.dumps(body).encode())
        request = urllib.request.Request((address or self.address) + path, data=data, method=method or ("GET" if data is None else "POST"),
                                         headers=headers or {})
        try:
            with urllib.request.urlopen(request, timeout=60) as answer:
                status, text, kind = answer.status, answer.read().decode(), answer.headers["Content-Type"]
        except urllib.error.HTTPError as error:
            status, text, kind = error.code, error.read().decode(), error.headers["Content-Type"]
        return status, json.loads(text) if kind.startswith("application/json") else text

    def state(self):
        status, state = self.ask("state")
        assert status == 200, state
        self.revision = state["revision"]
        return state

    def post(self, path, body=None, expect=200):
        if self.revision is None:
            self.state()
        status, answer = self.ask(f"{path}{'&' if '?' in path else '?'}revision={self.revision}", body if body is not None else b"")
        assert status == expect, (path, status, answer)
        if status == 200:
            self.revision = answer["revision"]
        return answer

    def labels(self, shape):
        status, answer = self.ask(f"labels/{shape}")
        assert status == 200, answer
        return [expanded(answer[name]) for name in ("labels", "patches")]

    def end(self):
        assert self.ask("end", b"")[0] == 200
        assert self.process.wait(timeout=30) == 0


def expanded(runs):
    labels = []
    for run in runs.split(","):
        label, _, count = run.partition("*")
        labels += [int(label)] * int(count or 1)
    return labels


def seg(path):
    with open(path, encoding="ascii") as file:
        return [int(line) for line in file]


def check_who_is_refused(server):
    other = server.address.rsplit("/", 2)[0]
    assert server.ask("/state", address=other)[0] == 404, "without a token"
    assert server.ask("/" + "0" * 32 + "/state", address=other)[0] == 404, "with another token"
    assert server.ask("state", headers={"Host": "example.org"})[0] == 403, "by another name of this machine"
    assert server.ask("state", headers={"Origin": "http://example.org"})[0] == 403, "from a page elsewhere"
    assert server.ask("state", method="DELETE")[0] == 405
    assert server.ask("nowhere")[0] == 404 and server.ask("labels/99")[0] == 422 and server.ask("mesh/x")[0] == 422
    # A connection that stays silent keeps nobody waiting.
    import socket
    host, port = server.address.split("/")[2].split(":")
    with socket.create_connection((host, int(port))):
        assert server.ask("state")[0] == 200
    with open("/proc/net/tcp", encoding="ascii") as file:
        listening = [line.split()[1] for line in file if line.split()[3] == "0A"]
    assert f"0100007F:{int(port):04X}" in listening and f"00000000:{int(port):04X}" not in listening, "127.0.0.1 alone"


def check_acts(server, run):
    state = server.state()
    names = [shape["name"] for shape in state["shapes"]]
    for number, name in enumerate(names):
        assert server.labels(number)[0] == seg(f"{run}/labels/{name}.seg"), "a session begins with the labels of the run"
    status, page = server.ask("")
    assert status == 200 and "cosegEdit" in page and "http://" not in page.split("<script>")[0], "the page"
    assert len(server.ask("mesh/0")[1]) > 1000

    # A patch, a piece and a face get another part, and keep it.
    before, patches = server.labels(0)
    face = len(before) // 2
    part = 1 - before[face]
    server.post(f"label/0?face={face}&region=patch&part={part}")
    after = server.labels(0)[0]
    assert all(label == part for label, patch in zip(after, patches) if patch == patches[face]), "a painted patch"
    assert json.load(open(f"{run}/corrections.json"))["acts"][-1] == {"act": "label", "part": part, "shape": names[0], "patches": str(patches[face])}
    assert server.post("undo")["undone"] == 1
    assert server.labels(0)[0] == before, "undo"
    server.post("redo")
    assert server.labels(0)[0] == after, "redo"
    server.post(f"label/1?face=5&region=face&part={1 - server.labels(1)[0][5]}")
    wanted = 1 - seg(f"{run}/labels/{names[1]}.seg")[5]
    assert server.labels(1)[0][5] == wanted, "a painted face"
    found = server.labels(2)[0]
    server.post(f"label/2?face=0&region=piece&part={1 - found[0]}")
    assert server.labels(2)[0][0] == 1 - found[0], "a painted piece"
    server.post("undo")

    # Parts: a new one, a split, a merge, names and colours.
    state = server.post("act", {"act": "new-part"})
    assert [p["number"] for p in state["parts"]] == [0, 1, 2]
    server.post("act", {"act": "label", "part": 2, "shape": names[3], "faces": "0-20"})
    assert set(server.labels(3)[0][:21]) == {2}
    state = server.post("act", {"act": "merge", "part": 2, "into": 0})
    assert [p["number"] for p in state["parts"]] == [0, 1] and 2 not in server.labels(3)[0]
    state = server.post("act", {"act": "name", "part": 0, "name": "Beine \u00fc"})
    assert state["parts"][0]["name"] == "Beine \u00fc"
    assert server.post("act", {"act": "color", "part": 0, "color": "#123456"})["parts"][0]["color"] == "#123456"

    # What is asked next, and a confirmed shape.
    question = server.ask("next")[1]
    assert 0 <= question["shape"] < len(names) and "in doubt" in question["reason"], question
    shown = server.labels(question["shape"])[0]
    state = server.post(f"confirm/{question['shape']}")
    assert state["shapes"][question["shape"]]["confirmed"] and server.labels(question["shape"])[0] == shown
    assert server.ask("next")[1]["shape"] != question["shape"]

    # What cannot be meant is said, and changes nothing.
    kept = open(f"{run}/corrections.json").read()
    assert "no part 9" in server.post("act", {"act": "merge", "part": 9, "into": 0}, expect=422)["error"]
    assert "contradict each other" in server.post("act", {"act": "absent", "part": shown[0], "shape": names[question["shape"]]}, expect=422)["error"]
    assert "is no JSON" in server.post("act", b"{", expect=422)["error"]
    assert "region must be" in server.post("label/0?face=1&region=all&part=0", expect=422)["error"]
    assert "nothing can be done" in server.post("explode", expect=422)["error"]
    assert server.ask(f"undo?revision={server.revision - 1}", b"")[0] == 409, "another page has done something meanwhile"
    assert open(f"{run}/corrections.json").read() == kept
    return names


def main():
    coseg, run = sys.argv[1:3]
    ranks = int(sys.argv[3]) if len(sys.argv) > 3 else 1
    server = Server(coseg, run, ranks)
    check_who_is_refused(server)
    names = check_acts(server, run)
    now = [server.labels(number)[0] for number in range(len(names))]
    port = server.address.split(":")[2].split("/")[0]

    def refused(options, words, code):
        done = subprocess.run([coseg, "edit", run, "--quiet", *options], capture_output=True, text=True, timeout=100)
        assert done.returncode == code and words in done.stderr and done.stderr.count("\n") == 1, (done.returncode, done.stderr)

    refused([], "another coseg edit works on", 4)
    # Killed in the middle, it loses nothing that was done.
    os.kill(server.process.pid, signal.SIGKILL) if ranks == 1 else server.end()
    server.process.wait(timeout=30)
    again = Server(coseg, run)
    assert [again.labels(number)[0] for number in range(len(names))] == now, "labels after a kill"
    assert again.state()["parts"][0]["name"] == "Beine \u00fc"
    status, saved = again.ask("save", b"")
    assert status == 200 and saved["folder"] == run + "/corrected", saved
    assert [seg(f"{run}/corrected/{name}.seg") for name in names] == now
    os.remove(f"{run}/.corrections.lock")  # so that the port is what is in the way
    taken = again.address.split(":")[2].split("/")[0]
    refused(["--port", taken], "Address already in use", 2)
    again.end()
    assert port, port
    print(f"ok: coseg edit on {ranks} ranks")


if __name__ == "__main__":
    main()
