#!/usr/bin/env python3
"""Writes the hostile glTF files of this folder, and prints their lines of expected.txt.

Each is a small triangle scene in which one thing is wrong. Run it here after a change; the files are committed.
"""
import base64
import copy
import json
import pathlib
import struct

FOLDER = pathlib.Path(__file__).resolve().parent


def floats(*numbers):
    return struct.pack(f"<{len(numbers)}f", *numbers)


BUFFER = floats(0, 0, 0, 1, 0, 0, 0, 1, 0) + struct.pack("<4H", 0, 1, 2, 0)


def base():
    """A lit triangle that a camera sees."""
    return {
        "asset": {"version": "2.0"},
        "buffers": [{"byteLength": len(BUFFER), "uri": data_uri(BUFFER)}],
        "bufferViews": [{"buffer": 0, "byteLength": 36}, {"buffer": 0, "byteOffset": 36, "byteLength": 6}],
        "accessors": [{"bufferView": 0, "componentType": 5126, "count": 3, "type": "VEC3"},
                      {"bufferView": 1, "componentType": 5123, "count": 3, "type": "SCALAR"}],
        "materials": [{"emissiveFactor": [1, 1, 1]}],
        "meshes": [{"primitives": [{"attributes": {"POSITION": 0}, "indices": 1, "material": 0}]}],
        "cameras": [{"type": "perspective", "perspective": {"yfov": 1, "aspectRatio": 8, "znear": 0.1}}],
        "nodes": [{"mesh": 0}, {"camera": 0, "translation": [0.3, 0.3, 2]}],
        "scenes": [{"nodes": [0, 1]}],
        "scene": 0,
    }


def data_uri(data):
    return "data:application/octet-stream;base64," + base64.b64encode(data).decode()


FILES = {}


def hostile(name, expected):
    """Registers a change of the base scene under a name with the beginning of its message."""
    def register(change):
        scene = copy.deepcopy(base())
        result = change(scene)
        FILES[f"gltf_{name}.gltf"] = (result if isinstance(result, (str, bytes)) else json.dumps(scene), expected)
    return register


@hostile("accessor_beyond_its_buffer", "#/accessors/0: 4 elements reach beyond the buffer view, which has 36")
def _(s): s["accessors"][0]["count"] = 4


@hostile("accessor_of_9e15_elements", "#/accessors/0: 9000000000000000 elements reach beyond")
def _(s): s["accessors"][0]["count"] = 9000000000000000


@hostile("accessor_of_1e9_zeros", "#/accessors/0/count: an accessor without data has 1000000000 elements")
def _(s): s["accessors"][0] = {"componentType": 5126, "count": 1000000000, "type": "VEC3"}


@hostile("accessor_of_minus_1_elements", "#/accessors/0/count: this is -1, expected an integer of at least 0")
def _(s): s["accessors"][0]["count"] = -1


@hostile("accessor_of_words", "#/accessors/0/count: this is of type string, expected a number")
def _(s): s["accessors"][0]["count"] = "many"


@hostile("accessor_nan", "#/accessors/0: element 0 is not finite")
def _(s): s["buffers"][0]["uri"] = data_uri(floats(float("nan")) + BUFFER[4:])


@hostile("accessor_offset_2_63", "#/accessors/0/byteOffset: this is 9223372036854775808")
def _(s): s["accessors"][0]["byteOffset"] = 2 ** 63


@hostile("accessor_stride_of_1", "#/accessors/0: elements of 12 bytes overlap, expected a stride of at least that, found 1")
def _(s): s["bufferViews"][0]["byteStride"] = 1


@hostile("accessor_sparse_beyond", "#/accessors/0/sparse/indices: index 3 is out of range, the accessor has 3")
def _(s):
    s["buffers"].append({"byteLength": 16, "uri": data_uri(struct.pack("<I", 3) + floats(1, 1, 1))})
    s["bufferViews"] += [{"buffer": 1, "byteLength": 4}, {"buffer": 1, "byteOffset": 4, "byteLength": 12}]
    s["accessors"][0]["sparse"] = {"count": 1, "indices": {"bufferView": 2, "componentType": 5125},
                                   "values": {"bufferView": 3}}


@hostile("index_beyond_the_vertices", "#/meshes/0/primitives/0: vertex index 9 is out of range, there are 3")
def _(s): s["buffers"][0]["uri"] = data_uri(BUFFER[:36] + struct.pack("<4H", 0, 1, 9, 0))


@hostile("view_beyond_its_buffer", "#/bufferViews/0: bytes 0 to 1000 reach beyond the buffer, which has 44")
def _(s): s["bufferViews"][0]["byteLength"] = 1000


@hostile("buffer_shorter_than_claimed", "#/buffers/0: this buffer claims 1000000000000 bytes, more than the 44 there are")
def _(s): s["buffers"][0]["byteLength"] = 1000000000000


@hostile("buffer_of_a_device", "#/buffers/0/uri: \"/dev/zero\" lies outside of the scene's folder")
def _(s): s["buffers"][0]["uri"] = "/dev/zero"


@hostile("buffer_above_the_folder", "#/buffers/0/uri: \"../../../etc/passwd\" lies outside of the scene's")
def _(s): s["buffers"][0]["uri"] = "../../../etc/passwd"


@hostile("buffer_escaped_above_the_folder", "#/buffers/0/uri: \"../x\" lies outside of the scene's folder")
def _(s): s["buffers"][0]["uri"] = "%2e%2e%2fx"


@hostile("buffer_of_a_server", "#/buffers/0/uri: \"http://localhost/x\" is not in the scene's folder")
def _(s): s["buffers"][0]["uri"] = "http://localhost/x"


@hostile("buffer_of_no_base64", "#/buffers/0/uri: this data URI is damaged, expected base64")
def _(s): s["buffers"][0]["uri"] = "data:;base64,****"


@hostile("node_below_itself", "#/nodes/0: this node is a descendant of itself, expected a tree of nodes")
def _(s): s["nodes"][0]["children"] = [0]


@hostile("node_of_two_parents", "#/nodes/3/children/0: node 0 is a child of two nodes, expected one parent")
def _(s): s["nodes"] += [{"children": [0]}, {"children": [0]}]


@hostile("node_of_nan", ":1:")
def _(s): return json.dumps(s).replace('"mesh": 0}', '"mesh": 0, "scale": [NaN, 1, 1]}')


@hostile("node_at_1e300", "#/meshes/0/primitives/0: shape \"trianglemesh\" has a position that is not finite")
def _(s): s["nodes"][0]["translation"] = [1e300, 0, 0]


@hostile("node_matrix_of_3_numbers", "#/nodes/0/matrix: this array has 3 numbers, expected 16")
def _(s): s["nodes"][0]["matrix"] = [1, 2, 3]


@hostile("nesting_of_100000", ": the JSON text is nested more than 200 levels deep")
def _(s): return '{"a":' * 100000


@hostile("number_1e400", ": a number of the JSON text is out of range")
def _(s): return json.dumps(s).replace("0.1}", "1e400}")


@hostile("text_not_utf8", ":1:")
def _(s): return json.dumps(s).encode().replace(b'"2.0"', b'"2.0\xff"')


@hostile("material_that_is_not_there", "#/meshes/0/primitives/0: index 7 into \"materials\" is out of range")
def _(s): s["meshes"][0]["primitives"][0]["material"] = 7


@hostile("image_of_garbage", "#/materials/0/pbrMetallicRoughness/baseColorTexture: cannot read image")
def _(s):
    s["materials"][0]["pbrMetallicRoughness"] = {"baseColorTexture": {"index": 0}}
    s["textures"] = [{"source": 0}]
    s["images"] = [{"bufferView": 0, "mimeType": "image/png"}]


@hostile("skin_without_joints", "#/skins/0/joints: a skin has no joints, expected at least one")
def _(s):
    s["skins"] = [{"joints": []}]
    s["nodes"][0]["skin"] = 0


@hostile("draco_of_garbage", "#/meshes/0/primitives/0/extensions/KHR_draco_mesh_compression: the Draco data")
def _(s):
    s["meshes"][0]["primitives"][0]["extensions"] = {
        "KHR_draco_mesh_compression": {"bufferView": 0, "attributes": {"POSITION": 0}}}


@hostile("meshopt_of_garbage", "#/bufferViews/0/extensions/EXT_meshopt_compression: the packed bytes are damaged")
def _(s):
    s["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {
        "buffer": 0, "byteLength": 36, "byteStride": 12, "count": 3, "mode": "ATTRIBUTES"}}


@hostile("meshopt_of_1e12_elements", "#/bufferViews/0/extensions/EXT_meshopt_compression/count: this claims more")
def _(s):
    s["bufferViews"][0]["extensions"] = {"EXT_meshopt_compression": {
        "buffer": 0, "byteLength": 36, "byteStride": 12, "count": 1000000000000, "mode": "ATTRIBUTES"}}


@hostile("extension_of_nobody", "#/extensionsRequired/0: the file requires the extension \"ACME_magic\"")
def _(s): s["extensionsRequired"] = ["ACME_magic"]


@hostile("animation_backwards", "#/animations/0/samplers/0: the times of keyframes are missing or not in increasing order, expected increasing ones")
def _(s):
    s["buffers"].append({"byteLength": 32, "uri": data_uri(floats(2, 1) + floats(*range(6)))})
    s["bufferViews"] += [{"buffer": 1, "byteLength": 8}, {"buffer": 1, "byteOffset": 8, "byteLength": 24}]
    s["accessors"] += [{"bufferView": 2, "componentType": 5126, "count": 2, "type": "SCALAR"},
                       {"bufferView": 3, "componentType": 5126, "count": 2, "type": "VEC3"}]
    s["animations"] = [{"samplers": [{"input": 2, "output": 3}],
                        "channels": [{"sampler": 0, "target": {"node": 0, "path": "translation"}}]}]


@hostile("camera_of_nan_aspect", "#/cameras/0/perspective/aspectRatio: this is -1.000000, expected a number above 0")
def _(s): s["cameras"][0]["perspective"]["aspectRatio"] = -1


@hostile("lists_that_are_objects", "#/nodes: this is of type object, expected an array")
def _(s): s["nodes"] = {"0": {}}


@hostile("nothing_wrong", "picture")
def _(s): pass


def main():
    for name, (text, expected) in sorted(FILES.items()):
        (FOLDER / name).write_bytes(text if isinstance(text, bytes) else text.encode())
        print(f"{name}: picture" if expected == "picture" else f"{name}: 3 {name}{expected}")


if __name__ == "__main__":
    main()
