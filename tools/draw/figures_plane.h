// The figures that look at flat charts and at fluencies (see figures.h).
#pragma once

#include "draw/figures.h"

namespace draw {

isolod::Status draw_figure_5(const FigureTask& task);
isolod::Status draw_figure_6(const FigureTask& task);
isolod::Status draw_figure_8(const FigureTask& task);
isolod::Status draw_figure_9(const FigureTask& task);
isolod::Status draw_figure_10(const FigureTask& task);
isolod::Status draw_figure_11(const FigureTask& task);
isolod::Status draw_figure_12(const FigureTask& task);
isolod::Status draw_figure_13(const FigureTask& task);
isolod::Status draw_figure_17(const FigureTask& task);
isolod::Status draw_figure_18(const FigureTask& task);
isolod::Status draw_figure_20(const FigureTask& task);

}  // namespace draw
