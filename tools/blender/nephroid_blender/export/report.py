"""Collects warnings about what an export approximates or leaves out."""


class Report:
    """Warnings in the order of their first appearance, each once."""

    def __init__(self):
        self._warnings = {}

    def warn(self, thing, message):
        """Adds "thing: message"; the message says what is wrong and what is done instead."""
        self._warnings[f"{thing}: {message}"] = True

    @property
    def warnings(self):
        return list(self._warnings)
