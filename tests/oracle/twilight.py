"""Writes compiler/src/scene/twilight.rs: 128 colours of matplotlib's cyclic map `twilight` (B. Bechtold; published by
matplotlib under CC0), at even distances around the cycle of its 510.

    pip install matplotlib numpy
    python3 tests/oracle/twilight.py > compiler/src/scene/twilight.rs
"""

import matplotlib
import numpy as np

COUNT = 128


def main():
    colours = np.array(matplotlib.colormaps["twilight"].colors)
    cycle = np.vstack([colours, colours[:1]])
    place = np.arange(COUNT) * len(colours) / COUNT
    sampled = np.stack([np.interp(place, np.arange(len(cycle)), cycle[:, k]) for k in range(3)], axis=1)
    print("//! The cyclic colour map `twilight` of matplotlib (B. Bechtold, CC0). Written by `tests/oracle/twilight.py`.")
    print()
    print("/// sRGB at even distances around the cycle.")
    print("#[rustfmt::skip]")
    print(f"pub(super) const TWILIGHT: [[f64; 3]; {COUNT}] = [")
    for colour in sampled:
        print("    [" + ", ".join(f"{part:.5f}" for part in colour) + "],")
    print("];")


main()
