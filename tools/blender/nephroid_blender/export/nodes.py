"""Walks along the links of a node tree, through groups, reroutes and muted nodes."""
from dataclasses import dataclass


@dataclass(frozen=True)
class Node:
    """A node in its groups; `groups` are the group nodes around it, the innermost last."""
    node: object
    groups: tuple = ()

    @property
    def type(self):
        return self.node.type

    @property
    def name(self):
        return self.node.label or self.node.name

    def input(self, *names):
        """The first enabled input of one of these names (Blender 3 and 4 differ), or None."""
        for name in names:
            for socket in self.node.inputs:
                if socket.enabled and name in (socket.name, socket.identifier):
                    return Input(socket, self.groups)
        return None

    def inputs(self):
        return [Input(socket, self.groups) for socket in self.node.inputs if socket.enabled]


@dataclass(frozen=True)
class Output:
    node: Node
    name: str


@dataclass(frozen=True)
class Input:
    socket: object
    groups: tuple

    @property
    def default(self):
        return self.socket.default_value

    @property
    def is_linked(self):
        return self.source() is not None

    def source(self):
        """The output that this input takes its value from; None without a link."""
        return _source(self.socket, self.groups)

    def resolved(self):
        """This input, or the one of a group around it that it only passes on."""
        return _resolved(self.socket, self.groups)


def _resolved(socket, groups):
    while socket.links:
        link = socket.links[0]
        if link.from_node.type == "REROUTE":
            socket = link.from_node.inputs[0]
        elif link.from_node.type == "GROUP_INPUT" and groups:
            socket = _with_identifier(groups[-1].inputs, link.from_socket.identifier)
            groups = groups[:-1]
        else:
            break
    return Input(socket, groups)


def _source(socket, groups):
    found = _resolved(socket, groups)
    socket, groups = found.socket, found.groups
    if not socket.links:
        return None
    link = socket.links[0]
    node = link.from_node
    if node.mute:
        for inner in node.internal_links:
            if inner.to_socket == link.from_socket:
                return _source(inner.from_socket, groups)
        return None
    if node.type == "GROUP" and node.node_tree:
        for inside in node.node_tree.nodes:
            if inside.type == "GROUP_OUTPUT" and inside.is_active_output:
                socket = _with_identifier(inside.inputs, link.from_socket.identifier)
                return _source(socket, groups + (node,))
        return None
    return Output(Node(node, groups), link.from_socket.name)


def _with_identifier(sockets, identifier):
    return next(s for s in sockets if s.identifier == identifier)


def active_output(tree, kind):
    """The output node of a tree that Cycles would take ('OUTPUT_MATERIAL' ...), or None."""
    found = [n for n in tree.nodes if n.type == kind]
    for wanted in ("CYCLES", "ALL"):
        for node in found:
            if node.target == wanted and node.is_active_output:
                return Node(node)
    return Node(found[0]) if found else None
