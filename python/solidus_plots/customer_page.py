"""The page of a customer's report as HTML for A4 paper: four pages, each a section of its own."""

import base64
from html import escape
import math

STYLE = """
@page { size: A4; margin: 14mm 16mm 18mm 16mm; font: 7.5pt "DejaVu Sans", "Liberation Sans", Arial, sans-serif; color: #666;
  @bottom-left { content: FOOTER; } @bottom-right { content: PAGE " " counter(page) "/" counter(pages); } }
* { box-sizing: border-box; }
body { margin: 0 auto; max-width: 178mm; font: 9.5pt/1.38 "DejaVu Sans", "Liberation Sans", Arial, sans-serif; color: #1b1b1b; }
section { break-after: page; }
section:last-child { break-after: auto; }
.first { height: 264mm; display: flex; flex-direction: column; } .first > * { flex: none; }
.first > figure { flex: 0 1 116mm; min-height: 40mm; margin-top: 4mm; } .first img.picture { width: 100%; height: 100%; object-fit: contain; }
header { display: flex; justify-content: space-between; align-items: flex-start; gap: 8mm; border-bottom: 1.2mm solid ACCENT;
  padding-bottom: 4mm; margin-bottom: 5mm; }
header img { max-height: 18mm; max-width: 60mm; }
header .firm { text-align: right; white-space: pre-line; font-size: 8.5pt; }
h1 { font-size: 18pt; line-height: 1.15; margin: 0 0 1mm; color: ACCENT; }
h2 { font-size: 12.5pt; margin: 0 0 3mm; color: ACCENT; border-bottom: 0.3mm solid #bbb; padding-bottom: 1mm; }
h3 { font-size: 10pt; margin: 4mm 0 1.2mm; }
p { margin: 0 0 2.5mm; white-space: pre-line; }
table { border-collapse: collapse; width: 100%; }
th, td { text-align: left; vertical-align: top; padding: 0.8mm 2mm 0.8mm 0; border-bottom: 0.2mm solid #ddd; }
th { font-weight: 600; }
td.number, th.number { text-align: right; white-space: nowrap; font-variant-numeric: tabular-nums; }
tr { break-inside: avoid; }
.facts { width: auto; margin-bottom: 4mm; } .facts th { padding-right: 6mm; font-weight: 400; color: #555; }
.small { font-size: 7.6pt; line-height: 1.3; } .small td, .small th { padding: 0.45mm 2mm 0.45mm 0; }
figure { margin: 0 0 4mm; text-align: center; break-inside: avoid; } figure img { max-width: 178mm; max-height: 116mm; }
.warning { border-left: 1mm solid #c60; padding-left: 3mm; }
@media screen { body { padding: 8mm; max-width: 194mm; } }
"""


def number_text(value, error=None):
    """A value with as many digits as its error allows, two of which are shown; four digits without an error."""
    if error is None or not error > 0 or not math.isfinite(error):
        return f"{value:.4g}"
    digits = 1 - math.floor(math.log10(error))
    if value and abs(error) > 100 * abs(value):  # the value says nothing with such an error
        return f"{value:.2g}"
    return f"{round(value, digits):.{max(digits, 0)}f}"


def error_text(error):
    if error == 0:
        return "0"
    digits = 1 - math.floor(math.log10(error))
    return f"{round(error, digits):.{max(digits, 0)}f}"


def _table(head, rows, kind="", numbers=()):
    """A table of texts, which are escaped here. `numbers`: the columns that are set to the right."""
    def cells(row, tag):
        return "".join(f'<{tag}{" class=number" if i in numbers else ""}>{escape(str(cell))}</{tag}>' for i, cell in enumerate(row))
    top = f"<thead><tr>{cells(head, 'th')}</tr></thead>" if head else ""
    return f'<table class="{kind}">{top}<tbody>{"".join(f"<tr>{cells(row, chr(116) + chr(100))}</tr>" for row in rows)}</tbody></table>'


def _facts(rows):
    return '<table class="facts">' + "".join(f"<tr><th>{escape(name)}</th><td>{escape(value)}</td></tr>" for name, value in rows) + "</table>"


def _picture(file):
    return f'<figure><img class="picture" alt="{escape(file.stem)}" src="data:image/png;base64,{base64.b64encode(file.read_bytes()).decode()}"></figure>'


def _paragraphs(title, texts, kind=""):
    if not texts:
        return ""
    return f"<h3>{escape(title)}</h3>" + "".join(f'<p class="{kind}">{escape(text)}</p>' for text in texts)


def _css_text(text):
    """A text as CSS writes it: everything but letters, digits and spaces by its number."""
    return '"' + "".join(c if c.isascii() and (c.isalnum() or c == " ") else f"\\{ord(c):x} " for c in text) + '"'


def page_of(template, report):
    """The whole page. Nothing of it may load or run anything, whatever is in a case or a template."""
    style = STYLE.replace("ACCENT", template.text("colour") or "#1f4e79")
    style = style.replace("FOOTER", _css_text(template.text("footer") or report.title)).replace("PAGE", _css_text(template.words["page"]))
    sections = [("first", first_page(template, report)), ("pictures", picture_page(template, report)),
                ("answers", answer_page(template, report)), ("materials", material_page(template, report))]
    body = "".join(f'<section class="{kind}">{content}</section>' for kind, content in sections)
    policy = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
    return (f'<!DOCTYPE html>\n<html><head><meta charset="utf-8"><meta http-equiv="Content-Security-Policy" content="{policy}">'
            f"<title>{escape(report.title)}</title><style>{style}</style></head><body>{body}</body></html>\n")


def first_page(template, report):
    """Who, what and when; the answers in short; the most telling picture."""
    words = template.words
    logo = f'<img alt="logo" src="{template.logo}">' if template.logo else ""
    firm = "\n".join(filter(None, (template.text("company"), template.text("address"))))
    head = f'<header><div>{logo}</div><div class="firm">{escape(firm)}</div></header>' if logo or firm else ""
    rows = [(words[key], template.text(key)) for key in ("customer", "order", "part", "author") if template.text(key)]
    rows += [(words["date"], report.date), (words["program"], report.program), (words["outcome"], report.outcome)]
    introduction = f"<p>{escape(template.text('introduction'))}</p>" if template.text("introduction") else ""
    short = _table((), [(row.name, _value(row)) for row in report.answers[:6]], numbers=(1,))
    return (f"{head}<h1>{escape(report.title)}</h1><p>{escape(words['report'])}</p>{_facts(rows)}{introduction}"
            f"<h2>{escape(words['summary'])}</h2>{short}{''.join(map(_picture, report.pictures[:1]))}")


def _value(row):
    error = f" ± {error_text(row.error)}" if row.error is not None else ""
    return f"{number_text(row.value, row.error)}{error}{' ' + row.unit if row.unit not in ('', '1') else ''}"


def picture_page(template, report):
    return f"<h2>{escape(template.words['pictures'])}</h2>" + "".join(map(_picture, report.pictures[1:3]))


def answer_page(template, report):
    """All answers with their errors, what was assumed, what the program warned of."""
    words = template.words
    unit = [" " + row.unit if row.unit not in ("", "1") else "" for row in report.answers]
    rows = [(row.name, number_text(row.value, row.error) + of, error_text(row.error) + of if row.error is not None else words["no_error"])
            for row, of in zip(report.answers, unit)]
    out = f"<h2>{escape(words['answers'])}</h2>" + _table((words["answer"], words["value"], words["error"]), rows, "small", (1, 2))
    out += f'<p class="small" style="margin-top:2mm"><b>{escape(words["limits"])}.</b> {escape(words["limits_text"])}</p>'
    out += f"<h2>{escape(words['assumptions'])}</h2>"
    out += _table((words["body"], words["material"], words["start"], words["mass"]), report.bodies, "small", (3,))
    for title, lines in ((words["contacts"], report.contacts), (words["surroundings"], report.surroundings), (words["numerics"], report.numerics)):
        out += _paragraphs(title, lines, "small")
    out += _paragraphs(words["warnings"], report.warnings, "small warning")
    return out + _paragraphs(words["remarks"], [template.text("remarks")] if template.text("remarks") else [])


def material_page(template, report):
    """Every property of every material with its source."""
    words = template.words
    out = f"<h2>{escape(words['materials'])}</h2>"
    for material in report.materials:
        out += f"<h3>{escape(material.title)} ({escape(', '.join(material.bodies))})</h3>"
        out += _table((words["property"], words["source"]), material.sources, "small")
    return out
