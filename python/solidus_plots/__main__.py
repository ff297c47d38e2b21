from solidus_plots.plot_case import main

raise SystemExit(main())
