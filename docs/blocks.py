"""The generated blocks of a document: what stands between `<!-- NAME: generated -->` and `<!-- end -->`."""

import re


def _block(name):
    return re.compile(rf"(<!-- {name}: generated -->\n\n)(.*?)(\n\n<!-- end -->)", re.DOTALL)


def block_of(path, name):
    """What stands between the markers of a name.

    Raises AssertionError where there are none.
    """
    found = _block(name).search(path.read_text())
    assert found, f"{path} has no block <!-- {name}: generated -->"
    return found[2]


def write_blocks(path, blocks):
    """Puts each text between the markers of its name.

    Raises AssertionError where there are none.
    """
    text = path.read_text()
    for name, block in blocks.items():
        assert _block(name).search(text), f"{path} has no block <!-- {name}: generated -->"
        text = _block(name).sub(lambda found, block=block: found[1] + block + found[3], text)
    path.write_text(text)
