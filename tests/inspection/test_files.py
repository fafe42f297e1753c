"""Files appear whole or not at all, and none of somebody else's is lost."""

import numpy as np
import pytest

from softshadow.errors import SoftShadowError
from softshadow.inspection.files import MARK, own, write_whole

pytestmark = pytest.mark.interpreted


def write_own(path):
    path.write_text(f"<!-- {MARK} -->")


def test_a_new_file_is_written_under_its_name(tmp_path):
    assert write_whole(tmp_path / "a.html", write_own) == tmp_path / "a.html"
    assert [p.name for p in tmp_path.iterdir()] == ["a.html"]


def test_own_files_are_replaced_and_foreign_ones_only_by_force(tmp_path):
    path = tmp_path / "a.html"
    write_whole(path, write_own)
    write_whole(path, write_own)
    path.write_text("my homework")
    with pytest.raises(SoftShadowError, match="was not written by softshadow; force=True"):
        write_whole(path, write_own)
    assert path.read_text() == "my homework"
    write_whole(path, write_own, force=True)
    assert own(path)


def test_a_failed_write_leaves_what_was_there(tmp_path):
    path = tmp_path / "a.html"
    write_whole(path, write_own)

    def fail(temporary):
        temporary.write_text("half")
        raise RuntimeError("the disk is full")

    with pytest.raises(RuntimeError):
        write_whole(path, fail)
    assert own(path)
    assert [p.name for p in tmp_path.iterdir()] == ["a.html"]


@pytest.mark.parametrize(("name", "said"), [("no/such/a.png", "does not exist"), ("", "is a folder")])
def test_places_that_cannot_be_written_are_named(tmp_path, name, said):
    with pytest.raises(SoftShadowError, match=said):
        write_whole(tmp_path / name, write_own)


def test_an_npz_of_somebody_else_is_foreign(tmp_path):
    np.savez(tmp_path / "a.npz", image=np.zeros(3))
    (tmp_path / "b.npz").write_text("no archive")
    assert not own(tmp_path / "a.npz")
    assert not own(tmp_path / "b.npz")
