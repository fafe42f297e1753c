// what screen readers and the keyboard need, and furo leaves out
addEventListener("load", () => {
  // the captions of the contents are headings without a level
  for (const caption of document.querySelectorAll(".caption[role=heading]")) caption.setAttribute("aria-level", "2");
  // what scrolls sideways can be reached by Tab, then scrolled by the arrow keys
  for (const box of document.querySelectorAll("pre, .table-wrapper"))
    if (box.scrollWidth > box.clientWidth) box.tabIndex = 0;
});
