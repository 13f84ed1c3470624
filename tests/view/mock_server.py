#!/usr/bin/env python3
# Speaks the protocol of the live view with synthetic pictures, so that the page can be developed
# and tested without the renderer: tests/view/mock_server.py [PORT [TOKEN]]. Prints the address.
import copy
import json
import math
import os
import random
import secrets
import sys
import threading
import time
import urllib.parse
from http.server import BaseHTTPRequestHandler, ThreadingHTTPServer

import mock_scene
from mock_pictures import (
    encode, inspection, mixed, png, relative_errors, small_png, tiles_of)

PAGE = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "src", "view", "page")
TYPES = {".html": "text/html; charset=utf-8", ".css": "text/css", ".js": "text/javascript",
         ".svg": "image/svg+xml"}
MAX_PASSES = 40
PREVIEW_DIVISOR = 4


class Render:
    """The state of a render and its thread. All members are guarded by `changed`."""

    def __init__(self, token):
        self.changed = threading.Condition()
        self.token = token
        self.generation, self.version, self.events = 1, 0, 0
        self.status, self.moving = "rendering", False
        self.passes, self.started = 0, time.time()
        self.pose = copy.deepcopy(mock_scene.START)
        self.settings = {"integrator": "mixed", "integrators": ["mixed", "path", "photon"],
                         "routes": "", "presets": ["split", "caustics"], "layers": "lights",
                         "seed": 0, "time": None, "noise": None, "resolution": [320, 240],
                         "crop": [0, 1, 0, 1]}
        self.film = self.tile_versions = None
        self.preview = False
        self.comparisons = {}
        threading.Thread(target=self.run, daemon=True).start()

    def notify(self):
        self.events += 1
        self.changed.notify_all()

    def restart(self):
        self.generation += 1
        self.passes, self.started = 0, time.time()
        if self.status != "paused":
            self.status = "rendering"
        self.notify()

    def run(self):
        rendered = 0  # generation of the film, negative for a coarse one
        while True:
            with self.changed:
                generation, moving = self.generation, self.moving
                pose, settings = copy.deepcopy(self.pose), copy.deepcopy(self.settings)
            wanted = -generation if moving else generation
            if rendered == wanted:
                self.one_pass()
                continue
            if rendered == 0:
                self.render(generation, True, pose, settings)
            if self.render(generation, moving, pose, settings):
                rendered = wanted

    def render(self, generation, coarse, pose, settings):
        full = settings["resolution"]
        size = [max(1, n // PREVIEW_DIVISOR) for n in full] if coarse else full
        x0, x1, y0, y1 = settings["crop"]
        window = [int(x0 * size[0]), int(y0 * size[1]),
                  max(int(x0 * size[0]) + 1, math.ceil(x1 * size[0])),
                  max(int(y0 * size[1]) + 1, math.ceil(y1 * size[1]))]
        film = mock_scene.Film(pose, size, window, lambda: self.generation == generation)
        with self.changed:
            if not film.complete or self.generation != generation:
                return False
            self.version += 1
            self.film, self.preview = film, coarse
            self.film.generation = generation
            self.tile_versions = [self.version] * len(tiles_of(film))
            self.passes = 0 if coarse else 1
            self.notify()
        return True

    def one_pass(self):
        """Waits, then makes new noise in a third of the tiles."""
        with self.changed:
            events = self.events
            self.changed.wait_for(lambda: self.events != events, 0.7)
            if self.moving or self.preview or self.status != "rendering":
                return
            self.passes += 1
            self.version += 1
            for index, (x, y, w, h) in enumerate(tiles_of(self.film)):
                if index % 3 == self.passes % 3:
                    self.tile_versions[index] = self.version
                    width = self.film.window[2] - self.film.window[0]
                    spread = 0.2 / math.sqrt(self.passes)
                    for row in range(y, y + h):
                        for column in range(x, x + w):
                            self.film.noise[row * width + column] = 1 + random.gauss(0, spread)
            if self.passes >= MAX_PASSES:
                self.status = "done"
            self.notify()

    def state(self):
        seconds = time.time() - self.started
        width, height = self.settings["resolution"]
        x0, x1, y0, y1 = self.settings["crop"]
        layers = [("picture", "picture", "RGB"), *((n, "route", "RGB") for n in mock_scene.ROUTES),
                  *((n, "light", "RGB") for n in mock_scene.LIGHTS), ("albedo", "feature", "RGB"),
                  ("N", "feature", "XYZ"), ("Z", "feature", "Z")]
        left_out = ("light",) if self.settings["layers"] == "routes" else ()
        return {
            "scene": "mock/ball-on-floor.pbrt", "kind": "scene", "status": self.status,
            "message": "", "warnings": ["light \"sky\": no portal, so it is sampled everywhere"],
            "notes": ["the ball has no material, so it is diffuse"],
            "report": ["photon emission guided to 16 targets: 40.6 % of photon paths useful",
                       "light sampling: tree of 3 lights"],
            "generation": self.generation, "version": self.version, "width": width,
            "height": height, "preview": self.preview,
            "window": [int(x0 * width), int(y0 * height), math.ceil(x1 * width),
                       math.ceil(y1 * height)],
            "progress": {"seconds": seconds, "passes": self.passes, "passes_wanted": MAX_PASSES,
                         "seconds_left": 0.7 * (MAX_PASSES - self.passes),
                         "fraction": self.passes / MAX_PASSES,
                         "error": 0.4 / math.sqrt(self.passes + 1), "rays_per_second": 2.1e6,
                         "photons": 120000},
            "settings": self.settings,
            "layers": [{"name": n, "kind": k, "channels": c} for n, k, c in layers
                       if k not in left_out],
            "mix": {"exact": True, "why": ""},
            "camera": {**self.pose, "type": "perspective", "can_move": True, "mirrored": True},
            "comparisons": [{"id": i, "name": c.name} for i, c in self.comparisons.items()],
            "save_directory": None}


class Handler(BaseHTTPRequestHandler):
    protocol_version = "HTTP/1.1"
    render = None

    def log_message(self, *_):
        pass

    def answer(self, status, body=b"", kind="application/json", headers=()):
        self.send_response(status)
        self.send_header("Content-Type", kind)
        self.send_header("Content-Length", str(len(body)))
        self.send_header("Content-Security-Policy", "default-src 'self'")
        self.send_header("Referrer-Policy", "no-referrer")
        for name, value in headers:
            self.send_header(name, value)
        self.end_headers()
        self.wfile.write(body)

    def json(self, value):
        self.answer(200, json.dumps(value).encode())

    def problem(self, status, text):
        self.answer(status, json.dumps({"error": text}).encode())

    def allowed(self):
        return f"nephroid={self.render.token}" in (self.headers.get("Cookie") or "")

    def do_GET(self):
        url = urllib.parse.urlparse(self.path)
        query = dict(urllib.parse.parse_qsl(url.query))
        if query.get("token") == self.render.token:
            cookie = f"nephroid={self.render.token}; HttpOnly; SameSite=Strict; Path=/"
            self.answer(302, headers=[("Location", "/"), ("Set-Cookie", cookie)])
        elif not self.allowed():
            self.problem(403, "open the address that the program printed")
        elif url.path.startswith("/api/"):
            self.get_api(url.path[5:], query)
        else:
            self.get_file(url.path)

    def get_file(self, path):
        name = os.path.basename(path) or "index.html"
        file = os.path.join(PAGE, name)
        if not os.path.isfile(file):
            self.problem(404, f"{name}: not found")
            return
        with open(file, "rb") as opened:
            self.answer(200, opened.read(), TYPES[os.path.splitext(name)[1]])

    def get_api(self, name, query):
        render = self.render
        if name == "events":
            self.stream_events()
        elif name == "state":
            with render.changed:
                self.json(render.state())
        elif name == "first":
            with render.changed:
                render.changed.wait_for(lambda: render.film, 1)
                self.answer(200, small_png(render.film), "image/png")
        elif name == "frame":
            self.get_frame(query)
        elif name == "probe":
            with render.changed:
                size = zip("xy", render.film.size, render.settings["resolution"])
                answer = inspection(render, *(int(query[axis]) * film_edge // edge
                                              for axis, film_edge, edge in size))
            self.json({key: answer[key] for key in ("value", "error", "samples")})
        elif name == "compare":
            shown = mixed(render.film, query.get("mix"))
            errors = relative_errors(shown, render.comparisons[query["with"]])
            mean = sum(errors) / max(1, len(errors))
            path = f"/api/heat?with={query['with']}&kind="
            trimmed = sorted(errors)[:-max(1, len(errors) // 1000)]
            self.json({"relmse": mean,
                       "relmse_trim": sum(trimmed) / max(1, len(trimmed)),
                       "flip": min(1, math.sqrt(mean)),
                       "heat": {"relmse": path + "relmse", "flip": path + "flip"}})
        elif name == "heat":
            self.get_heat(query)
        elif name == "save":
            self.save(query)
        else:
            self.problem(404, f"{name}: not known")

    def get_frame(self, query):
        render = self.render
        with render.changed:
            film, version = render.film, render.version
            if "comparison" in query:
                film = render.comparisons[query["comparison"]]
                body = encode(film, ["picture"], list(range(len(tiles_of(film)))), 1, False, 1)
            else:
                since = int(query.get("since", 0))
                if film is None or (since >= version and
                                    int(query["generation"]) == film.generation):
                    self.answer(204)
                    return
                if int(query["generation"]) != film.generation or since > version:
                    since = 0
                tiles = [i for i, changed in enumerate(render.tile_versions) if changed > since]
                body = encode(film, query["layers"].split(","), tiles, version, render.preview,
                              render.passes)
        self.answer(200, body, "application/octet-stream")

    def get_heat(self, query):
        film = mixed(self.render.film, query.get("mix"))
        errors = relative_errors(film, self.render.comparisons[query["with"]])
        levels = bytearray()
        for error in errors:
            level = min(255, int(255 * math.sqrt(error)))
            levels += bytes((level, level * level // 255, max(0, 96 - level)))
        width, height = film.window[2] - film.window[0], film.window[3] - film.window[1]
        self.answer(200, png(width, height, bytes(levels)), "image/png")

    def save(self, query):
        kind = query["kind"]
        if kind not in ("camera", "exr", "png", "scene"):
            self.problem(400, f"kind: '{kind}' is not valid")
            return
        if kind == "camera":
            pose = self.render.pose
            numbers = " ".join(f"{v:g}" for n in ("eye", "target", "up") for v in pose[n])
            self.answer(200, f"LookAt {numbers}\n".encode(), "text/plain")
            return
        body = f"mock {kind} {query.get('mix', '')}".encode()
        self.answer(200, body, "application/octet-stream",
                    [("Content-Disposition", f'attachment; filename="mock.{kind}"')])

    def stream_events(self):
        self.send_response(200)
        self.send_header("Content-Type", "text/event-stream")
        self.send_header("Connection", "close")
        self.end_headers()
        self.close_connection = True
        seen = -1
        try:
            while True:
                with self.render.changed:
                    self.render.changed.wait_for(lambda: self.render.events != seen, 5)
                    seen, state = self.render.events, self.render.state()
                self.wfile.write(f"event: state\ndata: {json.dumps(state)}\n\n".encode())
                self.wfile.flush()
                time.sleep(0.1)
        except OSError:
            pass

    def do_POST(self):
        size = int(self.headers.get("Content-Length", 0))
        body = self.rfile.read(size)
        if not self.allowed():
            self.problem(403, "open the address that the program printed")
            return
        url = urllib.parse.urlparse(self.path)
        name = url.path[5:]
        query = dict(urllib.parse.parse_qsl(url.query))
        try:
            with self.render.changed:
                if name == "upload":
                    self.json({"id": self.keep(query["name"], "file1")})
                elif name == "snapshot":
                    key = chr(ord("A") + len(self.render.comparisons))
                    passes = f"{key}: {self.render.passes} passes"
                    self.json({"id": self.keep(passes, key, query.get("mix"))})
                else:
                    self.post_api(name, json.loads(body))
        except (KeyError, ValueError) as error:
            self.problem(400, str(error))

    def post_api(self, name, body):
        render = self.render
        if name == "camera":
            render.moving = bool(body.pop("moving", False))
            render.pose.update(body)
            render.restart()
            self.json({"generation": render.generation})
        elif name == "render":
            action = body.pop("action", None)
            if action in ("pause", "resume"):
                render.status = "paused" if action == "pause" else "rendering"
                render.notify()
            else:
                render.settings.update(body)
                render.restart()
            self.json({})
        elif name == "pick":
            camera = mock_scene.Camera(render.pose, *render.settings["resolution"])
            *_, depth, point = mock_scene.trace(camera, body["x"], body["y"])
            self.json({"point": point, "depth": depth} if point else {"point": None})
        elif name == "inspect":
            self.json(inspection(render, body["x"], body["y"]))
        else:
            self.problem(404, f"{name}: not known")

    def keep(self, name, key, mix=None):
        film = mixed(self.render.film, mix)
        film.name = name
        self.render.comparisons[key] = film
        self.render.notify()
        return key

    def do_DELETE(self):
        query = dict(urllib.parse.parse_qsl(urllib.parse.urlparse(self.path).query))
        with self.render.changed:
            self.render.comparisons.pop(query.get("id"), None)
            self.render.notify()
        self.json({})


def main():
    port = int(sys.argv[1]) if len(sys.argv) > 1 else 0
    Handler.render = Render(sys.argv[2] if len(sys.argv) > 2 else secrets.token_hex(16))
    server = ThreadingHTTPServer(("127.0.0.1", port), Handler)
    server.daemon_threads = True
    print(f"http://127.0.0.1:{server.server_port}/?token={Handler.render.token}", flush=True)
    server.serve_forever()


if __name__ == "__main__":
    main()
