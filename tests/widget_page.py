"""A page with the browser's side of a widget, whose model is the Python side: what one sets, the other one gets."""

import json
import shutil
from base64 import b64encode
from collections.abc import Iterator
from contextlib import contextmanager
from pathlib import Path
from typing import Any

import pytest

import softshadow.notebook

FOLDER = Path(softshadow.notebook.__file__).parent
PAGE = """<!doctype html><html lang="en"><head><meta charset="utf-8"><title>widget</title><style>
body{margin:16px;font-family:sans-serif;background:#fff;color:#111}
body.dark{background:#111;color:#eee}</style></head>
<body><main><h1>A notebook</h1><div id="cell"></div></main></body></html>"""
# a model as anywidget gives it; `toPython` returns what changed there, in order
START = """async ({esm, css, state}) => {
  document.head.append(Object.assign(document.createElement("style"), {textContent: css}));
  const bytes = (text) => new DataView(Uint8Array.from(atob(text), (c) => c.charCodeAt(0)).buffer);
  const decoded = (value) => value && value.bytes !== undefined ? bytes(value.bytes) : value;
  for (const key in state) state[key] = decoded(state[key]);
  const listeners = {};
  let unsent = {};
  const fire = (key) => (listeners["change:" + key] ?? []).forEach((listener) => listener());
  window.model = {
    get: (key) => state[key],
    set: (key, value) => { state[key] = value; unsent[key] = value; fire(key); },
    on: (event, listener) => (listeners[event] ??= []).push(listener),
    off: (event, listener) => { listeners[event] = listeners[event].filter((other) => other !== listener); },
    save_changes: async () => {
      const sent = unsent;
      unsent = {};
      window.receive(JSON.parse(await window.toPython(JSON.stringify(sent))));
    },
  };
  window.receive = (changes) => { for (const [key, value] of changes) { state[key] = decoded(value); fire(key); } };
  const url = URL.createObjectURL(new Blob([esm], {type: "text/javascript"}));
  const widget = (await import(url)).default;
  window.stop = widget.render({model, el: document.getElementById("cell")});
}"""


def encoded(value: Any) -> Any:
    """Return a value as JSON can hold it."""
    return {"bytes": b64encode(value).decode()} if isinstance(value, bytes) else value


class Link:
    """The page's end of a Python widget: traits that change are collected until the page takes them."""

    def __init__(self, widget: Any) -> None:
        self.widget, self.changes = widget, []
        self.synced = [name for name in widget.keys if not name.startswith("_") and name not in ("layout", "tabbable")]
        widget.observe(lambda change: self.changes.append([change["name"], encoded(change["new"])]), self.synced)

    def state(self) -> dict[str, Any]:
        """Return all traits that the browser knows."""
        return {name: encoded(getattr(self.widget, name)) for name in self.synced}

    def take(self, sent: str) -> str:
        """Set what the browser has sent, and return what changed by it."""
        for name, value in json.loads(sent).items():
            setattr(self.widget, name, value)
        return self.changed()

    def changed(self) -> str:
        """Return the changes since the last call."""
        taken, self.changes = self.changes, []
        return json.dumps(taken)


@contextmanager
def browser_page(**options: Any) -> Iterator[Any]:
    """Open an empty page in Chromium that may not reach the network; its console errors are in `page.errors`."""
    sync_api = pytest.importorskip("playwright.sync_api")
    chromium = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
    if chromium is None:
        pytest.skip("no Chromium on this machine")
    with sync_api.sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=chromium, args=["--no-sandbox"])
        page = browser.new_page(**options)
        page.errors = []
        page.on("console", lambda message: page.errors.append(message.text) if message.type == "error" else None)
        page.on("pageerror", lambda error: page.errors.append(str(error)))
        page.on("request", lambda request: page.errors.append(request.url) if request.url.startswith("http") else None)
        yield page
        browser.close()


@contextmanager
def widget_page(widget: Any, dark: bool = False, **options: Any) -> Iterator[Any]:
    """Open a page with a widget; `page.push()` sends what Python has changed."""
    with browser_page(**options) as page:
        link = Link(widget)
        page.set_content(PAGE)
        if dark:
            page.evaluate("document.body.classList.add('dark')")
        page.expose_function("toPython", link.take)
        texts = {"esm": (FOLDER / "player.js").read_text(), "css": (FOLDER / "player.css").read_text()}
        page.evaluate(START, {**texts, "state": link.state()})
        page.push = lambda: page.evaluate("(changes) => window.receive(changes)", json.loads(link.changed()))
        yield page
