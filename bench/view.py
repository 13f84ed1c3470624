#!/usr/bin/env python3
"""Measures `nephroid view` as a browser without a screen sees it (docs/view.md has the figures).

    bench/view.py first SCENE             seconds from the start of the program to the first picture
    bench/view.py moves SCENE             seconds from a move of the camera to its first picture
    bench/view.py frames SCENE            seconds to fetch a whole frame while it renders
    bench/view.py share SCENE             what a page that follows the picture costs the renderer
    bench/view.py memory SCENE MINUTES    memory while the camera moves

Further arguments go to the program: --resolution 1920x1080.
"""
import http.client
import json
import re
import signal
import statistics
import struct
import subprocess
import sys
import time

PROGRAM = "build/release/bin/nephroid"
POLL = 0.002


class View:
    """A running view, and one browser."""

    def __init__(self, scene, *options):
        self.begin = time.time()
        self.process = subprocess.Popen([PROGRAM, "view", scene, "--no-browser", *options], stderr=subprocess.PIPE,
                                        text=True)
        address = re.search(r"http://([\d.]+):(\d+)/\?token=(\w+)", self.process.stderr.readline())
        self.host, self.port = address[1], int(address[2])
        self.cookie = None
        response, _ = self.request("GET", f"/?token={address[3]}")
        self.cookie = response.getheader("Set-Cookie").split(";")[0]

    def request(self, method, path, body=None):
        connection = http.client.HTTPConnection(self.host, self.port, timeout=60)
        headers = {"Cookie": self.cookie} if self.cookie else {}
        if body is not None:
            headers |= {"Content-Type": "application/json", "Origin": f"http://{self.host}:{self.port}"}
        connection.request(method, path, None if body is None else json.dumps(body), headers)
        response = connection.getresponse()
        content = response.read()
        connection.close()
        return response, content

    def state(self):
        return json.loads(self.request("GET", "/api/state")[1])

    def frame(self, generation=0, since=0):
        """The header of a frame; None if there is nothing newer."""
        response, content = self.request("GET", f"/api/frame?layers=picture&generation={generation}&since={since}")
        if response.status != 200:
            return None
        return json.loads(content[12:12 + struct.unpack("<I", content[8:12])[0]])

    def wait_for_frame(self, generation=0):
        while True:
            frame = self.frame()
            if frame and frame["layers"] and frame["generation"] >= generation:
                return frame
            time.sleep(POLL)

    def move(self, eye, moving):
        _, content = self.request("POST", "/api/camera", {"eye": eye, "moving": moving})
        return json.loads(content)["generation"]

    def megabytes(self):
        with open(f"/proc/{self.process.pid}/status") as status:
            return int(re.search(r"VmRSS:\s*(\d+)", status.read())[1]) / 1024

    def end(self):
        """Ends the program; returns the seconds that it takes."""
        begin = time.time()
        self.process.send_signal(signal.SIGTERM)
        self.process.wait()
        return time.time() - begin


def first(scene, options):
    seconds = []
    for _ in range(5):
        view = View(scene, *options)
        view.wait_for_frame()
        seconds.append(time.time() - view.begin)
        view.end()
    print(f"first picture: median {statistics.median(seconds):.2f} s, longest {max(seconds):.2f} s of {len(seconds)}")


def eye_of_move(camera, move):
    """A position beside that of the scene."""
    eye, target = camera["eye"], camera["target"]
    return [a + 0.02 * (move % 40 - 20) * (b - a) / 20 for a, b in zip(eye, target)]


def moves(scene, options):
    view = View(scene, *options)
    view.wait_for_frame()
    time.sleep(2)
    camera, seconds, widths = view.state()["camera"], [], []
    for move in range(60):
        begin = time.time()
        frame = view.wait_for_frame(view.move(eye_of_move(camera, move), True))
        seconds.append(time.time() - begin)
        widths.append(frame["width"])
        time.sleep(0.03)
    seconds.sort()
    print(f"a move to its picture: median {1000 * statistics.median(seconds):.0f} ms, "
          f"95 % within {1000 * seconds[int(0.95 * len(seconds))]:.0f} ms, longest {1000 * seconds[-1]:.0f} ms; "
          f"pictures {min(widths)} to {max(widths)} pixels wide")
    print(f"Ctrl-C to the end: {view.end():.2f} s")


def frames(scene, options):
    view = View(scene, *options)
    view.wait_for_frame()
    time.sleep(5)
    seconds = []
    for _ in range(15):
        begin = time.time()
        size = view.frame()
        seconds.append(time.time() - begin)
        time.sleep(0.5)
    view.end()
    print(f"a frame of {size['width']} x {size['height']}: median {1000 * statistics.median(seconds):.0f} ms, "
          f"longest {1000 * max(seconds):.0f} ms")


def rays(scene, options, follows):
    """Rays a second in 30 s of rendering, by a page that fetches every picture or none."""
    view = View(scene, "--time", "30s", *options)
    version = generation = pictures = 0
    while view.state()["status"] not in ("done", "failed"):
        if follows:
            frame = view.frame(generation, version)
            if frame:
                generation, version, pictures = frame["generation"], frame["version"], pictures + 1
        time.sleep(0.2)
    state = view.state()
    view.end()
    progress = state["progress"]
    return progress["rays_per_second"], pictures


def share(scene, options):
    ratios = []
    for pair in range(3):
        alone, _ = rays(scene, options, False)
        followed, pictures = rays(scene, options, True)
        ratios.append(followed / alone)
        print(f"{alone:.4g} rays a second alone, {followed:.4g} with {pictures} pictures fetched: "
              f"{followed / alone:.3f}")
    print(f"median {statistics.median(ratios):.3f}")


def memory(scene, minutes, options):
    view = View(scene, *options)
    view.wait_for_frame()
    camera = view.state()["camera"]
    begin, move, said = time.time(), 0, -1
    while time.time() - begin < 60 * float(minutes):
        for _ in range(20):
            view.wait_for_frame(view.move(eye_of_move(camera, move), True))
            move += 1
        view.wait_for_frame(view.move(eye_of_move(camera, move), False))
        time.sleep(1)
        minute = int((time.time() - begin) / 60)
        if minute != said:
            print(f"{minute} min, {move} moves: {view.megabytes():.0f} MB", flush=True)
            said = minute
    view.end()


def main():
    arguments = sys.argv[1:]
    if len(arguments) < 2 or arguments[0] not in ("first", "moves", "frames", "share", "memory"):
        sys.exit(__doc__)
    command, scene, *options = arguments
    if command == "memory":
        memory(scene, options[0], options[1:])
    else:
        globals()[command](scene, options)


if __name__ == "__main__":
    main()
