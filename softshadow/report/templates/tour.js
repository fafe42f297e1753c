// Keys of the tour: from chapter to chapter, and back to the overview.

const chapters = [document.getElementById("overview"), ...document.querySelectorAll(".chapter")];

// Return the number of the chapter that begins last at or above the top of the window.
function present() {
  return chapters.findLastIndex(chapter => chapter.getBoundingClientRect().top <= 8);
}

document.addEventListener("keydown", event => {
  const by = {",": -1, ".": 1, "0": -chapters.length}[event.key];
  if (by === undefined || event.ctrlKey || event.altKey || event.metaKey) return;
  const chapter = chapters[Math.min(Math.max(present() + by, 0), chapters.length - 1)];
  chapter.scrollIntoView();
  chapter.focus({preventScroll: true});
});
