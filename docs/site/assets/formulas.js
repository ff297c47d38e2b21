// Formulas are drawn by KaTeX, which comes with the site. The page's parts are marked by pymdownx.arithmatex.
document.addEventListener("DOMContentLoaded", () =>
  renderMathInElement(document.body, {
    delimiters: [{left: "\\[", right: "\\]", display: true}, {left: "\\(", right: "\\)", display: false}],
    throwOnError: false,
  }));
