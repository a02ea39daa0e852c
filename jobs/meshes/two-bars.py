#!/usr/bin/env python3
"""Writes two-bars.msh (Gmsh 4.1, ASCII): a bar of bricks on x in [0, 0.4] m named "steel", joined by a layer of pyramids and
tetrahedra to a bar of tetrahedra on x in [0.45, 0.8] m named "aluminium"; physical surfaces "left" and "right" at the ends."""

N, H = 4, 0.05  # cells across, cell size in m
BRICKS, LAYER = 8, 1
TETS = 7

nodes = {}


def node(x, y, z):
    return nodes.setdefault((round(x, 9), round(y, 9), round(z, 9)), len(nodes) + 1)


def corners(i, j, k):
    return [node(H * (i + a), H * (j + b), H * (k + c)) for c in (0, 1) for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))]


# Elements by (dimension, entity, Gmsh type).
blocks = {}


def add(key, element):
    blocks.setdefault(key, []).append(element)


STEEL, ALUMINIUM, LEFT, RIGHT = 1, 2, 1, 2
# Faces of a brick, counter-clockwise seen from outside.
FACES = [(0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7)]
PATHS = [(1, 2), (2, 3), (3, 7), (7, 4), (4, 5), (5, 1)]
for k in range(N):
    for j in range(N):
        for i in range(BRICKS):
            add((3, STEEL, 5), corners(i, j, k))
        c = corners(BRICKS, j, k)
        middle = node(H * (BRICKS + 0.5), H * (j + 0.5), H * (k + 0.5))
        for face in FACES:
            a = [c[m] for m in face]
            if face == (3, 0, 4, 7):  # towards the bricks: whole
                add((3, ALUMINIUM, 7), [a[0], a[3], a[2], a[1], middle])
            else:  # cut along the diagonals of the Kuhn tetrahedra: from corner 0 or to corner 6
                at = face.index(0) if 0 in face else face.index(6)
                a = a[at:] + a[:at]
                add((3, ALUMINIUM, 4), [a[0], a[2], a[1], middle])
                add((3, ALUMINIUM, 4), [a[0], a[3], a[2], middle])
        for i in range(BRICKS + LAYER, BRICKS + LAYER + TETS):
            c = corners(i, j, k)
            for p, q in PATHS:
                add((3, ALUMINIUM, 4), [c[0], c[p], c[q], c[6]])
        c = corners(0, j, k)
        add((2, LEFT, 3), [c[0], c[3], c[7], c[4]])
        c = corners(BRICKS + LAYER + TETS - 1, j, k)
        add((2, RIGHT, 2), [c[1], c[2], c[6]])
        add((2, RIGHT, 2), [c[1], c[6], c[5]])

with open(__file__.replace(".py", ".msh"), "w") as out:
    print("$MeshFormat\n4.1 0 8\n$EndMeshFormat", file=out)
    print('$PhysicalNames\n4\n2 1 "left"\n2 2 "right"\n3 1 "steel"\n3 2 "aluminium"\n$EndPhysicalNames', file=out)
    print("$Entities\n0 0 2 2", file=out)
    for tag in (1, 2, 1, 2):
        print(f"{tag} 0 0 0 1 1 1 1 {tag} 0", file=out)
    print("$EndEntities", file=out)
    print(f"$Nodes\n1 {len(nodes)} 1 {len(nodes)}\n3 1 0 {len(nodes)}", file=out)
    print("\n".join(str(n) for n in nodes.values()), file=out)
    for x, y, z in nodes:
        print(f"{x:g} {y:g} {z:g}", file=out)
    count = sum(len(b) for b in blocks.values())
    print(f"$EndNodes\n$Elements\n{len(blocks)} {count} 1 {count}", file=out)
    tag = 0
    for (dimension, entity, kind), elements in sorted(blocks.items()):
        print(dimension, entity, kind, len(elements), file=out)
        for e in elements:
            tag += 1
            print(tag, *e, file=out)
    print("$EndElements", file=out)
