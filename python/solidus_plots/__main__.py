import sys

from solidus_plots.verb import main

raise SystemExit(main(["plot_case", *sys.argv[1:]]))
