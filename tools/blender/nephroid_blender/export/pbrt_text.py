"""pbrt-v4 directives as text. It must not know Blender."""

IDENTITY = (1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1, 0, 0, 0, 0, 1)
ESCAPES = str.maketrans({"\\": r"\\", '"': r'\"', "\n": r"\n", "\r": r"\r", "\t": r"\t"})


def number(value):
    """The shortest text that is the same 32-bit float."""
    return f"{float(value):.9g}"


def quoted(text):
    """A string token."""
    return '"' + str(text).translate(ESCAPES) + '"'


def numbers(values):
    return "[" + " ".join(number(v) for v in values) + "]"


def _value(value):
    if isinstance(value, bool):
        return "true" if value else "false"
    if isinstance(value, str):
        return quoted(value)
    if isinstance(value, (tuple, list)) and value and isinstance(value[0], str):
        return "[" + " ".join(quoted(v) for v in value) + "]"
    if isinstance(value, int):
        return str(value)
    return numbers(value) if hasattr(value, "__len__") else number(value)


def directive(keyword, names=(), parameters=None):
    """One line, such as `Shape "sphere" "float radius" 2`. Keys are "type name"."""
    if isinstance(names, str):
        names = (names,)
    words = [keyword, *map(quoted, names)]
    for key, value in (parameters or {}).items():
        words.append(f"{quoted(key)} {_value(value)}")
    return " ".join(words)


def matrix_text(matrix):
    """The 16 numbers of Transform: column by column of a matrix that multiplies columns."""
    return numbers(matrix[row][column] for column in range(4) for row in range(4))


class SceneText:
    """Lines of a scene file."""

    def __init__(self):
        self._lines = []

    def add(self, keyword, names=(), parameters=None):
        self._lines.append(directive(keyword, names, parameters))

    def line(self, text):
        self._lines.append(text)

    def transform(self, matrix, at_close=None):
        """The current transform; with `at_close`, one that moves from `matrix` to it."""
        if at_close is None or matrix_text(matrix) == matrix_text(at_close):
            self.line("Transform " + matrix_text(matrix))
            return
        self.line("ActiveTransform StartTime")
        self.line("Transform " + matrix_text(matrix))
        self.line("ActiveTransform EndTime")
        self.line("Transform " + matrix_text(at_close))
        self.line("ActiveTransform All")

    def write(self, path):
        with open(path, "w", encoding="utf-8") as file:
            file.write("\n".join(self._lines) + "\n")
