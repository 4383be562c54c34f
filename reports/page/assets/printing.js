// Paper: light colours whatever the screen has, and of the table of configurations its first rows alone.

/** Listeners of the page's parts are called after these: they find the mode that they shall draw in. */
window.addEventListener("beforeprint", () => document.documentElement.setAttribute("data-paper", ""));
window.addEventListener("afterprint", () => document.documentElement.removeAttribute("data-paper"));

function isOnPaper() {
  return document.documentElement.hasAttribute("data-paper");
}

/** Calls a listener whenever the page goes to paper, and when it is back on the screen. */
function onPaperChange(listener) {
  window.addEventListener("beforeprint", listener);
  window.addEventListener("afterprint", listener);
}
