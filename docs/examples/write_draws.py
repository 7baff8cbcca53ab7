# Writes square.draws and the texture beside it without etalon: a textured square in clip space, seen in perspective. docs/formats.md#draws
import hashlib, json, struct, zlib

def png(width, height, rgb):  # rows from the top down, three bytes a texel
    def chunk(name, data):
        return struct.pack(">I", len(data)) + name + data + struct.pack(">I", zlib.crc32(name + data))
    rows = b"".join(b"\0" + rgb[y * 3 * width:(y + 1) * 3 * width] for y in range(height))
    return (b"\x89PNG\r\n\x1a\n" + chunk(b"IHDR", struct.pack(">IIBBBBB", width, height, 8, 2, 0, 0, 0))
            + chunk(b"IDAT", zlib.compress(rows)) + chunk(b"IEND", b""))

texture = png(4, 4, bytes(v for y in range(4) for x in range(4) for v in (64 * x, 64 * y, 255 * ((x + y) % 2))))
open("square.png", "wb").write(texture)

corners = [(-1, -1, 2), (1, -1, 2), (1, 1, 4), (-1, 1, 4)]  # x, y, w of the clip position; depth 0 is the middle of the range
vertices = b"".join(struct.pack("<10f", x, y, 0, w, (x + 1) / 2, (y + 1) / 2, 1, 1, 1, 1) for x, y, w in corners)
triangles = struct.pack("<6I", 0, 1, 2, 0, 2, 3)
header = json.dumps({
    "schema": "etalon/draws/1",
    "frame": {"width": 64, "height": 64},
    "state": {"subtexel_bits": 8, "snap": "nearest_even", "fill_rule": "left_ymin", "half_rounding": "nearest_even",
              "cull": "none", "depth_test": True},
    "images": [{"path": "square.png", "sha256": hashlib.sha256(texture).hexdigest()}],
    "draws": [{"space": "clip", "vertices": 4, "triangles": 2, "shading": "texture", "texture": 0,
               "sampler": {"filter": "nearest", "wrap_u": "clamp", "wrap_v": "clamp"}}],
}).encode()
open("square.draws", "wb").write(b"etalonDR" + struct.pack("<Q", len(header)) + header + vertices + triangles)
