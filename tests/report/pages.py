"""Pages read as a browser reads them: what they load, what they link to, and their text."""

from dataclasses import dataclass, field
from html.parser import HTMLParser
from pathlib import Path

LOADING = {"src", "href", "srcset", "data", "poster", "action", "background"}
# elements that have no end
VOID = {"img", "meta", "link", "br", "hr", "input"}


@dataclass
class Page(HTMLParser):
    """A page that has been read."""

    urls: list[tuple[str, str, str]] = field(default_factory=list)  # element, attribute, URL
    images: list[dict[str, str]] = field(default_factory=list)
    scripts: list[str] = field(default_factory=list)
    ids: set[str] = field(default_factory=set)
    words: list[str] = field(default_factory=list)
    within: list[str] = field(default_factory=list)

    def __post_init__(self) -> None:
        super().__init__()

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        attributes = {name: value or "" for name, value in attrs}
        self.urls += [(tag, name, value) for name, value in attributes.items() if name in LOADING]
        self.ids |= {attributes["id"]} if "id" in attributes else set()
        if tag == "img":
            self.images.append(attributes)
        if tag not in VOID:
            self.within.append(tag)

    def handle_endtag(self, tag: str) -> None:
        assert self.within, f"</{tag}> ends nothing"
        # the end of a list item or paragraph may be left out
        while (open_tag := self.within.pop()) != tag:
            assert open_tag in ("li", "p"), f"<{open_tag}> is not closed before </{tag}>"

    def handle_data(self, data: str) -> None:
        if self.within and self.within[-1] == "script":
            self.scripts.append(data)
        elif not self.within or self.within[-1] != "style":
            self.words.append(data)

    @property
    def text(self) -> str:
        """What is there to read, with single spaces."""
        return " ".join(" ".join(self.words).split())


def read_page(path: Path) -> Page:
    """Return a page; every element in it has to be closed."""
    page = Page()
    page.feed(path.read_text(encoding="utf-8"))
    page.close()
    assert page.within == []
    return page
