// one slide at a time: arrow keys, Page Up and Down, space, Home, End, the two buttons; F fills the screen
const slides = [...document.querySelectorAll(".slide")];
let current = 0;

function show(number) {
  current = Math.max(0, Math.min(slides.length - 1, number));
  slides.forEach((slide, index) => slide.classList.toggle("current", index === current));
  document.getElementById("previous").disabled = current === 0;
  document.getElementById("next").disabled = current === slides.length - 1;
  document.getElementById("status").textContent = `slide ${current + 1}: ${slides[current].querySelector("h1").textContent}`;
  if (location.hash !== `#${current + 1}` && location.protocol !== "about:") location.replace(`#${current + 1}`);
}

const KEYS = {
  ArrowRight: () => current + 1, ArrowDown: () => current + 1, PageDown: () => current + 1, " ": () => current + 1,
  ArrowLeft: () => current - 1, ArrowUp: () => current - 1, PageUp: () => current - 1,
  Home: () => 0, End: () => slides.length - 1,
};
document.addEventListener("keydown", (event) => {
  if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("button")?.matches(":focus") && event.key === " ") return;
  if (event.key === "f") {
    if (document.fullscreenElement) document.exitFullscreen();
    else document.documentElement.requestFullscreen();
  } else if (event.key in KEYS) {
    event.preventDefault();
    show(KEYS[event.key]());
  }
});
document.getElementById("previous").addEventListener("click", () => show(current - 1));
document.getElementById("next").addEventListener("click", () => show(current + 1));
window.addEventListener("hashchange", () => show(Number(location.hash.slice(1)) - 1 || 0));
document.documentElement.classList.add("scripted");
show(Number(location.hash.slice(1)) - 1 || 0);
document.documentElement.dataset.ready = "";
