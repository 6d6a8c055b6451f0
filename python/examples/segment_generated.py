#!/usr/bin/env python3
"""Makes 12 tables with known parts, cuts them into the same two parts, and draws them.

usage: segment_generated.py [PICTURE.png]
"""
import sys

import coseg

shapes = coseg.generate("table", 12, faces=2000)
result = coseg.segment(shapes, parts=2, patches=30, geodesic_samples=100)
for name, share in zip(result.names, result.part_areas):
    print(name, "shares of the area:", " ".join(f"{s:.2f}" for s in share))
print(f"accuracy {coseg.score(shapes, result, [shape.labels for shape in shapes]).accuracy:.3f}")
print(f"certified gap {result.certificate['relative_gap']:.1e}")
coseg.draw(shapes, result).savefig(sys.argv[1] if len(sys.argv) > 1 else "tables.png")
