// Light and dark: as the system has it, until the reader chooses.

import { choice } from "./dom.js";

const KEY = "comity-replay-theme";

/** A drop-down that chooses the theme. */
export function themeChoice() {
  const chosen = recall();
  use(chosen);
  return choice(
    "Theme",
    [
      ["auto", "Theme: auto"],
      ["light", "Light"],
      ["dark", "Dark"],
    ],
    chosen,
    (theme) => {
      use(theme);
      keep(theme);
    },
  );
}

function use(theme) {
  if (theme === "auto") document.documentElement.removeAttribute("data-theme");
  else document.documentElement.setAttribute("data-theme", theme);
}

// A browser may keep nothing for a page from a file: then the choice lasts as long as the page.
function recall() {
  try {
    return localStorage.getItem(KEY) ?? "auto";
  } catch {
    return "auto";
  }
}

function keep(theme) {
  try {
    localStorage.setItem(KEY, theme);
  } catch {
    return;
  }
}
