/** How the mould was filled, where the run began with it. */
import { fillingSection } from "../filling";
import { addSection, ofRuns } from "../section";



addSection({ id: "filling", title: "Filling", place: 20, build: (page) => ofRuns(page, (r) => r.meta.filling_text, fillingSection) });
