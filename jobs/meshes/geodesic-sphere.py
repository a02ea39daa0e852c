#!/usr/bin/env python3
"""Writes geodesic-sphere.off: the unit sphere as 320 triangles, an icosahedron whose faces are cut into 16.

usage: geodesic-sphere.py > geodesic-sphere.off
"""
import itertools

import math

CUTS = 4  # of every edge of the icosahedron


def main():
    golden = (1 + math.sqrt(5)) / 2
    corners = [p for s, t in itertools.product((-1, 1), repeat=2) for p in ((0, s, t * golden), (s, t * golden, 0), (t * golden, 0, s))]
    edge = 2
    distance = lambda p, q: math.dist(p, q)
    faces = [f for f in itertools.combinations(range(12), 3)
             if all(abs(distance(corners[a], corners[b]) - edge) < 1e-9 for a, b in itertools.combinations(f, 2))]
    number, points, triangles = {}, [], []

    def vertex(p):
        r = math.sqrt(sum(x * x for x in p))
        key = tuple(round(x / r, 9) for x in p)
        if key not in number:
            number[key] = len(points)
            points.append([x / r for x in p])
        return number[key]

    for a, b, c in faces:
        a, b, c = corners[a], corners[b], corners[c]
        normal = sum(x * (v * z - w * y) for x, (v, z, w, y) in
                     zip(a, ((b[1], c[2], b[2], c[1]), (b[2], c[0], b[0], c[2]), (b[0], c[1], b[1], c[0]))))
        if normal < 0:
            b, c = c, b
        at = lambda i, j: vertex([((CUTS - i - j) * x + i * y + j * z) / CUTS for x, y, z in zip(a, b, c)])
        for i in range(CUTS):
            for j in range(CUTS - i):
                triangles.append((at(i, j), at(i + 1, j), at(i, j + 1)))
                if i + j < CUTS - 1:
                    triangles.append((at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)))
    print("OFF")
    print(len(points), len(triangles), 0)
    for p in points:
        print("%.9f %.9f %.9f" % tuple(p))
    for t in triangles:
        print(3, *t)


if __name__ == "__main__":
    main()
