#!/usr/bin/env python3
# SPDX-License-Identifier: MIT
"""read_transport.py FILE.limnrt EXPECTED.f32 ...: relights transport files, written from docs/transport-format.md alone.

Prints the error of each file's lightmap, lit by the file's own lights and sky until it converges, against the expected one
(f32, layer by layer, RGBA), and fails where it exceeds 1e-3. The standard library is enough."""
import array, math, struct, sys
from operator import mul

MASK = (1 << 64) - 1
P1, P2, P3, P4, P5 = (0x9E3779B185EBCA87, 0xC2B2AE3D27D4EB4F, 0x165667B19E3779F9, 0x85EBCA77C2B2AE63, 0x27D4EB2F165667C5)
rotate = lambda v, n: (v << n | v >> (64 - n)) & MASK
mix = lambda lane, value: rotate((lane + value * P2) & MASK, 31) * P1 & MASK

def xxh64(data):
    at, n, h = 0, len(data), P5
    if n >= 32:
        a, b, c, d = (P1 + P2) & MASK, P2, 0, -P1 & MASK
        for w, x, y, z in struct.iter_unpack("<4Q", data[:n // 32 * 32]):
            a, b, c, d = mix(a, w), mix(b, x), mix(c, y), mix(d, z)
        h, at = (rotate(a, 1) + rotate(b, 7) + rotate(c, 12) + rotate(d, 18)) & MASK, n // 32 * 32
        for lane in (a, b, c, d):
            h = ((h ^ mix(0, lane)) * P1 + P4) & MASK
    h = (h + n) & MASK
    while n - at >= 8:
        h = (rotate(h ^ mix(0, struct.unpack_from("<Q", data, at)[0]), 27) * P1 + P4) & MASK
        at += 8
    if n - at >= 4:
        h = (rotate(h ^ struct.unpack_from("<I", data, at)[0] * P1 & MASK, 23) * P2 + P3) & MASK
        at += 4
    for byte in data[at:]:
        h = rotate(h ^ byte * P5 & MASK, 11) * P1 & MASK
    h = (h ^ h >> 33) * P2 & MASK
    h = (h ^ h >> 29) * P3 & MASK
    return h ^ h >> 32

def sections(data):
    magic, major, _, count, _, size, table_hash = struct.unpack_from("<8sIIIIQQ", data)
    assert magic == b"LIMNRT\r\n" and major == 2 and size == len(data), "not a transport file of version 2"
    assert xxh64(data[64:64 + 32 * count]) == table_hash, "the table is damaged"
    result = {}
    for k in range(count):
        tag, _, offset, length, digest = struct.unpack_from("<4sIQQQ", data, 64 + 32 * k)
        result[tag.decode()] = data[offset:offset + length]
        assert xxh64(result[tag.decode()]) == digest, f"{tag} is damaged"
    return result

dot = lambda a, b: sum(map(mul, a, b))
cross = lambda a, b: (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])
along = lambda a, d, t: (a[0] + d[0] * t, a[1] + d[1] * t, a[2] + d[2] * t)
wrapped = lambda i, n, wrap: (i % n, min(max(i, 0), n - 1), min(i % (2 * n), 2 * n - 1 - i % (2 * n)))[wrap]
unit = lambda a: along((0, 0, 0), a, 1 / math.sqrt(dot(a, a)))

def harmonics(x, y, z):
    return (0.2820948, 0.4886025 * y, 0.4886025 * z, 0.4886025 * x, 1.0925484 * x * y, 1.0925484 * y * z,
            0.3153916 * (3 * z * z - 1), 1.0925484 * x * z, 0.5462742 * (x * x - y * y))

def continued(c, n):
    """Light above the plane of normal n, with what continues below it."""
    r = 5 / (2 * math.sqrt(math.pi)) * c[0] - math.sqrt(3 / math.pi) * (n[0] * c[3] + n[1] * c[1] + n[2] * c[2])
    below = math.sqrt(3 * math.pi) / 2 * r
    return [c[0] + math.sqrt(math.pi) * r, c[1] - below * n[1], c[2] - below * n[2], c[3] - below * n[0], *c[4:]]

class Transport:
    def __init__(self, data):
        s = sections(data)
        words = lambda tag, kind="I": array.array(kind, s[tag])
        threes = lambda tag: list(struct.iter_unpack("<3f", s[tag]))
        self.dims = words("DIMS")
        self.normal, self.albedo = threes("SNRM"), threes("SALB")
        each, points = max(self.dims[21], 1), threes("SLPT" if self.dims[21] else "SPOS")
        normals = threes("SLNM") if "SLNM" in s and self.dims[21] else [n for n in self.normal for _ in range(each)]
        points = list(zip(points, normals))
        self.points = [points[k * each:(k + 1) * each] for k in range(self.dims[0])]
        self.emission, self.sky = threes("SEMI"), threes("SKYL")
        self.reads = [[(c, w) for c, w in zip(v[:4], v[4:]) if w > 0] for v in
                      (c + w for c, w in zip(struct.iter_unpack("<4I", s["SCAC"]), struct.iter_unpack("<4f", s["SCWT"])))]
        self.inner = [(a, b, w) for (a, b), w in zip(struct.iter_unpack("<2I", s["TCHI"]), words("TWGT", "f"))]
        self.links = self.read_links(s, words)
        begin, source, weight = words("FBEG"), words("FSRC"), words("FWGT", "f")
        self.fills = [[(source[k], weight[k]) for k in range(begin[c], begin[c + 1])] for c in range(self.dims[3])]
        begin, source, weight = words("LMBG"), words("LMSR"), words("LMWT", "H")
        self.texels = [[(source[k], weight[k] / 65535) for k in range(begin[t], begin[t + 1])]
                       for t in range(self.dims[11] * self.dims[12])]
        self.magnitude = words("SPAC", "f")[6]
        self.boxes = list(struct.iter_unpack("<3fI3fI", s["OBOX"]))
        self.triangles = [(v[:3], v[3:6], v[6:9], v[9]) for v in
                          (t + c for t, c in zip(struct.iter_unpack("<9f", s["OTRI"]), struct.iter_unpack("<I", s["OCUT"])))]
        self.cutouts, self.masks = [list(struct.iter_unpack(f, s[tag])) for f, tag in (("<9fI", "CTRI"), ("<Q5If", "CMSK"))]
        self.alpha = s["CTEX"]
        self.lights = list(struct.iter_unpack("<2I16f2I", s["LGHT"]))

    def read_links(self, s, words):
        """Per lightmap cache: node and what a radiosity of 1 there adds to the nine coefficients."""
        begin, exponent, result = words("LBEG"), words("LEXP", "b"), []
        normal = list(struct.iter_unpack("<3f", s["CNRM"]))
        all_links = list(struct.iter_unpack("<Ihhee", s["LINK"]))
        for c in range(self.dims[4]):
            result.append([])
            for node, ox, oy, u, t in all_links[begin[c]:begin[c + 1]]:
                x, y = ox / 32767, oy / 32767
                z = 1 - abs(x) - abs(y)
                fold = max(-z, 0)
                x, y = x - math.copysign(fold, x), y - math.copysign(fold, y)
                transport = t * 2.0 ** -exponent[c]
                g1, g2 = (2 - u) / 2, (2 - u) * 3 * (1 - u) / 6
                factors = (1, g1, g1, g1, g2, g2, g2, g2, g2)
                light = [transport * g * v for g, v in zip(factors, harmonics(*unit((x, y, z))))]
                result[-1].append((node, continued(light, normal[c])))
        return result

    def epsilon(self, p):
        return max(map(abs, p)) * 2.0 ** -19 + self.magnitude * 2.0 ** -20

    def occluded(self, origin, way, distance):
        inverse = [1 / (math.copysign(max(abs(d), 1e-20), d)) for d in way]
        waiting = [0] if self.boxes else []
        while waiting:
            box = self.boxes[waiting.pop()]
            spans = [sorted(((box[k] - origin[k]) * inverse[k], (box[4 + k] - origin[k]) * inverse[k])) for k in range(3)]
            if max(0, *(a for a, _ in spans)) > min(distance, *(b * (1 + 1e-6) for _, b in spans)):
                continue
            if box[7] == 0:
                waiting += [box[3], box[3] + 1]
            elif any(self.meets(origin, way, distance, t) for t in self.triangles[box[3]:box[3] + box[7]]):
                return True
        return False

    def meets(self, origin, way, distance, triangle):
        a = triangle[0]
        ab, ac, o = along(triangle[1], a, -1), along(triangle[2], a, -1), along(origin, a, -1)
        p, q = cross(way, ac), cross(o, ab)
        determinant = dot(ab, p) or math.nan  # of a ray along the triangle, which misses it
        u, v, t = dot(o, p) / determinant, dot(way, q) / determinant, dot(ac, q) / determinant
        return u >= 0 and v >= 0 and u + v <= 1 and 0 <= t <= distance and self.is_there(triangle[3], u, v)

    def is_there(self, cutout, u, v):
        if cutout == 0xffffffff:
            return True
        *corners, mask = self.cutouts[cutout]
        s, t, factor = ((1 - u - v) * a + u * b + v * c for a, b, c in zip(corners[:3], corners[3:6], corners[6:]))
        begin, width, height, wrap_s, wrap_t, nearest, cutoff = self.masks[mask]
        texel = lambda i, j: self.alpha[begin + wrapped(j, height, wrap_t) * width + wrapped(i, width, wrap_s)] / 255
        x, y = s * width - (not nearest) / 2, t * height - (not nearest) / 2
        i, j = math.floor(x), math.floor(y)
        f, g = (0, 0) if nearest else (x - i, y - j)
        rows = [texel(i, row) * (1 - f) + texel(i + 1, row) * f for row in (j, j + 1)]
        return factor * (rows[0] * (1 - g) + rows[1] * g) >= cutoff

    def irradiance(self, light, p, n):
        """Of a directional, point or spot light of colour 1, with its shadow."""
        kind, flags, x, y, z, *rest = light
        direction, strength, reach, inner, outer = rest[:3], *rest[6:10]
        distance, window, way = math.inf, 1, along((0, 0, 0), direction, -1)
        assert kind < 3, "this reader has no rectangles"
        if kind > 0:
            way = along((x, y, z), p, -1)
            distance = max(math.sqrt(dot(way, way)), 1e-8)
            way = along((0, 0, 0), way, 1 / distance)
            window = min(max(1 - (distance / reach) ** 4 if reach > 0 else 1, 0), 1) / distance ** 2
        if kind == 2:
            end = math.cos(outer)
            edge = (-dot(way, direction) - end) / (max(math.cos(inner), end + 1e-4) - end)
            window *= min(max(edge, 0), 1) ** 2
        cosine, e = dot(n, way), self.epsilon(p)
        if flags & 1 or cosine <= 0 or window <= 0 or (not flags & 2 and self.occluded(along(p, n, e), way, distance - e)):
            return 0
        return strength * window * cosine

    def relight(self, bounces=200):
        n, direct = self.dims[0], [[0, 0, 0] for _ in range(self.dims[0])]
        for light in self.lights:
            for k in range(n):
                e = sum(self.irradiance(light, p, m) for p, m in self.points[k]) / len(self.points[k])
                direct[k] = [direct[k][i] + light[8 + i] * e for i in range(3)]
        factor = [math.pi] + [2 * math.pi / 3] * 3 + [math.pi / 4] * 5
        basis = [[a * y for a, y in zip(factor, harmonics(*m))] for m in self.normal]
        read = {c for reads in self.reads for c, _ in reads}
        read |= {source for c in read for source, _ in self.fills[c]}
        channels = []
        for i in range(3):  # colours do not mix in a file that keeps colour in all bands
            indirect = [0.0] * n
            for _ in range(bounces):
                b = [self.albedo[k][i] * (direct[k][i] + indirect[k]) + math.pi * self.emission[k][i] for k in range(n)]
                b += [math.pi * l[i] for l in self.sky]
                for left, right, w in self.inner:
                    b.append(w * b[left] + (1 - w) * b[right])
                sh = self.gather(b, read)
                was, indirect = indirect, [max(0, sum(w * sum(map(mul, basis[k], sh[c])) for c, w in self.reads[k])) for k in range(n)]
                if max(abs(x - y) for x, y in zip(was, indirect)) <= 1e-5 * max(indirect):
                    break
            channels.append(self.gather(b, range(self.dims[4])))
        return [[sum(w * channels[i][c][l] for c, w in parts) for parts in self.texels] for l in range(9) for i in range(3)]

    def gather(self, b, which):
        sh = {c: [sum(b[node] * v[l] for node, v in self.links[c]) for l in range(9)] for c in which}
        for c in which:
            if self.fills[c]:
                sh[c] = [sum(w * sh[source][l] for source, w in self.fills[c]) for l in range(9)]
        return sh

def main(names):
    errors = []
    for name, expected in zip(names[::2], names[1::2]):
        got, want = Transport(open(name, "rb").read()).relight(), array.array("f", open(expected, "rb").read())
        texels = len(want) // 36
        pairs = [(got[3 * l + i][t], want[4 * (l * texels + t) + i]) for l in range(9) for i in range(3) for t in range(texels)]
        errors.append(math.sqrt(sum((g - w) ** 2 for g, w in pairs) / sum(w * w for _, w in pairs)))
        print(f"{name}: nRMSE {errors[-1]:.2e}")
    return max(errors) > 1e-3

sys.exit(main(sys.argv[1:]))
