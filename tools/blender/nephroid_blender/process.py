"""The program as a subprocess: its frames are read by a thread. It must not know Blender."""
import subprocess
import threading

from .frames import FrameError, read_frame

PATIENCE = 0.5  # seconds between a request to stop and the end by force


class RenderProcess:
    """A running render. All methods are for one thread, the one that shows the picture."""

    def __init__(self, program, arguments):
        """Starts the program. Raises OSError if there is none."""
        self._lock = threading.Lock()
        self._picture = self._progress = self._end = None
        self._messages = []
        self._errors = []
        self._process = subprocess.Popen([program, "render", *arguments], stdin=subprocess.DEVNULL,
                                         stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self._threads = [threading.Thread(target=read, daemon=True)
                         for read in (self._read_frames, self._read_errors)]
        for thread in self._threads:
            thread.start()

    def _read_frames(self):
        try:
            while True:
                frame = read_frame(self._process.stdout)
                if frame is None:
                    return
                self._keep(frame)
        except (FrameError, ValueError) as error:
            with self._lock:
                self._messages.append(("error", str(error)))
            self._process.terminate()

    def _keep(self, frame):
        with self._lock:
            if frame.kind == "picture":
                self._picture = frame
            elif frame.kind == "progress":
                self._progress = frame.header
            elif frame.kind == "end":
                self._end = frame.header
            else:
                self._messages.append((frame.kind, frame.header.get("text", "")))

    def _read_errors(self):
        for line in self._process.stderr:
            with self._lock:
                self._errors.append(line.decode("utf-8", "replace").rstrip())

    @property
    def is_running(self):
        return any(thread.is_alive() for thread in self._threads)

    def take_picture(self):
        """The newest picture that was not taken yet, or None."""
        with self._lock:
            picture, self._picture = self._picture, None
        return picture

    @property
    def has_picture(self):
        return self._picture is not None

    def take_messages(self):
        """(kind, text) of each new "note", "warning" and "error"."""
        with self._lock:
            messages, self._messages = self._messages, []
        return messages

    @property
    def progress(self):
        return self._progress

    @property
    def end(self):
        """The header of the last frame; None if the program did not end by itself."""
        return self._end

    def failure(self):
        """The end of standard error if the program failed without an `end` frame, else ""."""
        status = self._process.wait()
        if status == 0 or self._end is not None:
            return ""
        return "\n".join(self._errors[-5:]) or f"the program ended with status {status}"

    def stop(self):
        """Asks the program to end, and kills it after PATIENCE."""
        if self._process.poll() is None:
            self._process.terminate()
            try:
                self._process.wait(PATIENCE)
            except subprocess.TimeoutExpired:
                self._process.kill()
                self._process.wait()
        for thread in self._threads:
            thread.join(PATIENCE)
        self._process.stdout.close()
        self._process.stderr.close()
