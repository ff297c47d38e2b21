/** The case as it was read. */
import { h, save } from "../dom";
import type { Run } from "../run";
import { addSection, Content, perRun } from "../section";

function caseText(run: Run): Content[] {
  const pre = h("pre", { class: "case", tabindex: 0 });
  for (const line of run.meta.case_text.split("\n")) {
    if (/^\s*#/.test(line)) pre.append(h("span", { class: "c" }, line));
    else if (/^\s*\[/.test(line)) pre.append(h("span", { class: "s" }, line));
    else {
      const match = /^(\s*[A-Za-z0-9_]+\s*=)(.*)$/.exec(line);
      if (match) pre.append(h("span", { class: "k" }, match[1]), match[2]);
      else pre.append(line);
    }
    pre.append("\n");
  }
  return [
    h("p", { class: "hint" }, "As it was read, every default filled in; it runs again as it is. ",
      h("button", { class: "link", click: () => save("case.toml", run.meta.case_text) }, "Save case.toml")),
    pre,
  ];
}

addSection({ id: "case", title: "Case", place: 130, build: (page) => [perRun(page, caseText)] });
