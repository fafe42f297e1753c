"""2x2 pixel blocks: texture lookups with mipmaps take their derivatives from the neighbours in a block."""

import numpy as np

from softshadow.pipeline.records import Fragments


def in_blocks(fragments: Fragments) -> tuple[Fragments, np.ndarray]:
    """Return the complete 2x2 blocks of the fragments (B * 4,), and the number of each fragment in them (n,).

    A block begins at an even row and column and belongs to one triangle; its pixels are in the order (0, 0), (0, 1),
    (1, 0), (1, 1). Pixels that the triangle does not cover are shaded, too; their colours are dropped.
    """
    row, column, triangle = (a.astype(np.int64) for a in fragments)
    side = int(max(row.max(initial=0), column.max(initial=0))) // 2 + 1
    key = (triangle * side + row // 2) * side + column // 2
    # with `return_index`, NumPy merges runs that are sorted already: twice as fast here
    blocks, _, block = np.unique(key, return_index=True, return_inverse=True)
    triangles, first_rows, first_columns = blocks // side**2, blocks // side % side * 2, blocks % side * 2
    rows, columns = first_rows[:, None] + (0, 0, 1, 1), first_columns[:, None] + (0, 1, 0, 1)
    fields = (rows, columns, np.repeat(triangles[:, None], 4, axis=1))
    complete = Fragments(*(a.ravel().astype(np.int32) for a in fields))
    return complete, block * 4 + row % 2 * 2 + column % 2
