// The wordings that something said is made of, and the facts of each.

import { el } from "./dom.js";
import { plain } from "./words.js";

/** What is said, in its script and, where that is another one, in Latin letters. */
export function said(act) {
  const language = act.wordings?.[0]?.language ?? null;
  return [
    el("p", { class: "said", lang: language, dir: "auto" }, `“${act.text}”`),
    act.latin && el("p", { class: "latin" }, act.latin),
  ];
}

/** A list of wordings with language, script, register, occasion and review; null where there is none. */
export function wordings(act) {
  const made = act?.wordings ?? [];
  if (made.length === 0) return null;
  return el(
    "div",
    { class: "wordings" },
    el("p", { class: "faint" }, "Wordings"),
    el("ul", {}, made.map(facts)),
  );
}

function facts(one) {
  const kind = [plain(one.use), one.language, one.script, one.register];
  if (one.occasion === "first_meeting") kind.push("first meeting only");
  const review = one.reviewed_by ? `reviewed by ${one.reviewed_by} on ${one.reviewed_on}` : "reviewed by nobody";
  return el("li", {}, `${kind.join(", ")}: `, el("span", { lang: one.language, dir: "auto" }, one.text), ` (${review})`);
}
