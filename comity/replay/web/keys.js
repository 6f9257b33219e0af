// The keyboard: what a key does wherever the reader is, except where letters are typed.

/** Listen for keys; `acts` are functions by the key's name. */
export function listen(acts) {
  addEventListener("keydown", (event) => {
    if (event.ctrlKey || event.metaKey || event.altKey || event.target.closest("dialog")) return;
    const typing = event.target.closest("input:not([type=range]):not([type=checkbox]), select");
    if (typing && event.key !== "Escape") return;
    if (event.key === " " && event.target.closest("button, summary, input[type=checkbox]")) return;
    const act = acts[event.shiftKey && event.key.startsWith("Arrow") ? `Shift+${event.key}` : event.key];
    if (!act) return;
    event.preventDefault();
    act();
  });
}
