"""The bars that results are held against, and how verdicts are printed. Used by check_models.py."""

ROUGHER = ["cgal-elephant", "cgal-eight", "tri-Duck", "cgal-ChineseDragon-10kv"]  # closed, but not smooth everywhere

BARS = {
    "exact": "exactly V vertices, no unused one; a refusal only below what the shape needs, naming a number that works",
    "manifold": "edge- and vertex-manifold, consistently oriented",
    "side": "oriented as the input: volume of the same sign",
    "topology": "genus, boundary loops and components as the input",
    "triangles": "no degenerate and no duplicate triangle",
    "smooth": "Q mean >= 0.90, under 30 degrees <= 0.2 %, Hausdorff <= 0.8 %, RMS <= 0.06 %, no flip, <= 0.02 % doubtful ones",
    "crossings": "no more crossing pairs than the input has, or none but between sheets nearer than three spacings",
    "lines": "sharp and boundary lines within max(0.02 %, 1.2 sagittas) of edges, straight ones 1e-6, corners in place",
    "density": "where curvature sets the density: rank correlation of wished and realised >= 0.9",
    "fit": "with --fit: RMS <= 0.7 of the same mesh unfitted, Hausdorff no greater, Q mean no more than 0.02 lower, no flip",
    "arena": "bunny to 10,000 vertices in 64 MB",
    "time": "bunny to 10,000 vertices in 3 s; not with --ci, which may run on a busy machine",
    "even": "smooth closed: Q mean >= 0.93, valence 6 >= 94 %, cells vary by <= 0.045, least angle >= 32 and none under "
            "30 but near cones; elephant, eight, duck, dragon: Q mean >= 0.92, valence 6 >= 92 %",
    "small": "with sharp lines: Q least >= 0.3, mean >= 0.91, under 30 degrees only in wedges under 45 or beside pinned "
             "samples",
    "near": "fandisk: Hausdorff <= 0.19 %, RMS <= 0.0075 %; bunny, kitten, gargoyle: both at most 1.05 times CGAL's",
    "mass": "cell masses over their shares vary by <= 5 %; slope of realised over wished density 1 +- 0.02",
    "handles": "10, 50, 150 handles, 500 components, a tube 200:1, 401 loops: no flipped triangle at 20,000",
    "seams": "near former seams less the rest, and that less the same along seams that never were: Q mean within "
             "0.003, valence 6 within 1 point, cells' variation within 10 %; no longer chains of edges along them",
    "budgets": "every V from 1 to 300 exact and valid, or refused below the ceiling; the number named works, one less "
               "does not",
    "counts": "20 counts up to four times the input's: exact and valid, or refused as above",
    "lods": "20,000, 5,000, 1,250 and 300 vertices from one run: exact and valid; the bunny's in at most 60 % of the "
            "processor time of four runs",
    "broken": "a clean error or a repair, under 10 s, in memory of a small multiple of the file",
}


def verdict(bar, good, case, detail="", shown=False):
    """`shown`: the detail is printed of good ones too."""
    return {"bar": bar, "good": bool(good), "case": case, "detail": detail, "shown": shown}


def verdict_of(bar, case, values, note=""):
    """`values`: name, figure, whether it is good. All figures are shown, those that are bad with a mark."""
    words = [f"{name} {value:.4g}{'' if good else ' (!)'}" for name, value, good in values]
    return verdict(bar, all(good for _, _, good in values), case, ", ".join(words) + note, True)


def label(case):
    return " ".join([case.model, str(case.vertices)] + case.options)


def refusal(case):
    """A refusal counts only where V is below corners + 3 a loop + 4 a component, and must name a number that works."""
    found = case.result
    report = found["report"]
    needed = report.get("corners", 0) + 3 * report.get("boundary_loops", 0) + 4 * report.get("components", 0)
    excused = report.get("status") == "budget_too_small" and case.vertices < needed and found.get("retry") == 0
    named = f", {found['named']} named" if "named" in found else ""
    named += f", which gives exit code {found['retry']}" if found.get("retry") else ""
    return verdict("exact", excused, label(case), f"exit code {found['code']}: {found['errors'].split(': ', 2)[-1]}{named}")


def judge_smooth(case, mesh, compared):
    doubtful = 100.0 * compared["flipped_triangles"] / max(1, mesh["faces"])
    values = [("Q mean", mesh["q_mean"], mesh["q_mean"] >= 0.90),
              ("under 30", mesh["pct_tri_min_angle_lt30"], mesh["pct_tri_min_angle_lt30"] <= 0.2),
              ("Hausdorff", compared["hausdorff_pct"], compared["hausdorff_pct"] <= 0.8),
              ("RMS", compared["rms_pct"], compared["rms_pct"] <= 0.06),
              ("flips", compared["flipped_triangles_robust"], compared["flipped_triangles_robust"] == 0),
              ("doubtful %", doubtful, doubtful <= 0.02)]
    wrong = [f"{name} {value:.4g}" for name, value, good in values if not good]
    return verdict("smooth", not wrong, label(case), ", ".join(wrong))


def places(triangles, count=8):
    """Where the first of these triangles are."""
    words = [f"{t['angle']:.1f} at ({t['x']:.3g} {t['y']:.3g} {t['z']:.3g})" for t in triangles[:count]]
    return f"; {'; '.join(words)}{' ...' if len(triangles) > count else ''}" if words else ""


def own_compare(case):
    return case.result.get("own", {}).get("compare", {})


def judge_even(case, mesh):
    own = own_compare(case)
    if not own:
        return verdict("even", False, label(case), "not measured")
    q, valence = mesh["q_mean"], mesh["valence6_pct"]
    if case.model in ROUGHER:
        return verdict_of("even", label(case), [("Q mean", q, q >= 0.92), ("valence 6 %", valence, valence >= 92)])
    bare = own["small_triangles"] - own["small_near_cones"]
    values = [("Q mean", q, q >= 0.93), ("valence 6 %", valence, valence >= 94),
              ("cells", mesh["voronoi_area_cv"], mesh["voronoi_area_cv"] <= 0.045),
              ("least angle", own["angle_min_off_cones"], own["angle_min_off_cones"] >= 32),
              ("under 30", bare, bare == 0), ("near cones", own["small_near_cones"], True)]
    return verdict_of("even", label(case), values, places(own["small_triangle_list"]))


def judge_small(case, mesh):
    own = own_compare(case)
    if not own:
        return verdict("small", False, label(case), "not measured")
    bare = [t for t in own["small_triangle_list"] if not t["in_narrow_wedge"] and not t["beside_pin"]]
    values = [("Q least", mesh["q_min"], mesh["q_min"] >= 0.3), ("Q mean", mesh["q_mean"], mesh["q_mean"] >= 0.91),
              ("under 30", len(bare), not bare), ("in narrow wedges", own["small_in_narrow_wedges"], True),
              ("beside pinned", own["small_beside_pins"], True)]
    return verdict_of("small", label(case), values, places(bare))


def judge_near(case, compared):
    values = [("Hausdorff", compared["hausdorff_pct"], compared["hausdorff_pct"] <= 0.19),
              ("RMS", compared["rms_pct"], compared["rms_pct"] <= 0.0075)]
    if case.model == "cgal-fandisk":
        return [verdict_of("near", label(case), values)]
    if "peer" not in case.result:
        return []
    if not case.result["peer"]:
        return [verdict("near", False, label(case), "CGAL's program failed")]
    other = case.result["peer"]["compare"]
    values = [(name, compared[key] / other[key], compared[key] <= 1.05 * other[key])
              for name, key in (("Hausdorff over CGAL's", "hausdorff_pct"), ("RMS over CGAL's", "rms_pct"))]
    note = f"; CGAL's at {case.result['peer']['remeshed']['vertices']} vertices {other['hausdorff_pct']:.4g}, " \
           f"{other['rms_pct']:.4g} %"
    return [verdict_of("near", label(case), values, note)]


def judge_mass(case):
    """Where the wish hardly varies there is no slope to speak of."""
    own = own_compare(case)
    if not own:
        return verdict("mass", False, label(case), "not measured")
    values = [("variation", own["mass_variation_all"], own["mass_variation_all"] <= 0.05),
              ("inside", own["mass_variation"], True)]
    if own["log_wish_deviation"] >= 0.05:
        values.append(("slope", own["density_slope"], abs(own["density_slope"] - 1) <= 0.02))
    return verdict_of("mass", label(case), values)


def judge_lines(case):
    compared = own_compare(case)
    if not compared:
        return verdict("lines", False, label(case), "not measured")
    values = [("distance over bar", compared["line_worst_ratio"], compared["line_worst_ratio"] <= 1),
              ("straight %", compared["straight_to_rem_any_edge_max_pct"],
               compared["straight_to_rem_any_edge_max_pct"] <= 1e-4),
              ("corners missing", compared["corners_missing"], compared["corners_missing"] == 0)]
    wrong = [f"{name} {value:.4g}" for name, value, good in values if not good]
    return verdict("lines", not wrong, label(case), ", ".join(wrong))


def judge_fit(case):
    """Against the same mesh with its vertices on the surface."""
    found, unfitted = case.result, case.result["unfitted"]
    if not unfitted.get("judged"):
        return verdict("fit", False, label(case), "no unfitted mesh to compare with")
    mesh, compared = found["judged"]["remeshed"], found["judged"]["compare"]
    old_mesh, old = unfitted["judged"]["remeshed"], unfitted["judged"]["compare"]
    rms = compared["rms_pct"] / old["rms_pct"]
    values = [("RMS ratio", rms, rms <= 0.7),
              ("Hausdorff", compared["hausdorff_pct"], compared["hausdorff_pct"] <= old["hausdorff_pct"]),
              ("Q mean", mesh["q_mean"], mesh["q_mean"] >= old_mesh["q_mean"] - 0.02),
              ("flips", compared["flipped_triangles_robust"], compared["flipped_triangles_robust"] == 0),
              ("same triangles", unfitted["same_triangles"], unfitted["same_triangles"])]
    wrong = [f"{name} {value:.4g}" for name, value, good in values if not good]
    return verdict("fit", not wrong, label(case), ", ".join(wrong))


def crossing_words(case):
    """`0>7 (7 between sheets)`; where the judge that rounds counts otherwise, its numbers too."""
    kinds, rounded = case.result["kinds"], case.result.get("rounded")
    if "crossings_remeshed" not in kinds:
        return "not measured"
    exact = (kinds["crossings_original"], kinds["crossings_remeshed"])
    words = [f"{kinds['crossing_pairs_' + kind]} {kind.replace('_', ' ')}"
             for kind in ("folded", "between_sheets", "elsewhere") if kinds["crossing_pairs_" + kind]]
    if rounded and rounded != exact:
        words.append(f"rounded {rounded[0]}>{rounded[1]}")
    return f"{exact[0]}>{exact[1]}" + (f" ({', '.join(words)})" if words else "")


def judge_crossings(case):
    kinds = case.result["kinds"]
    good = "crossings_remeshed" in kinds and (kinds["crossings_remeshed"] <= kinds["crossings_original"] or
                                              kinds["crossing_pairs_folded"] + kinds["crossing_pairs_elsewhere"] == 0)
    return verdict("crossings", good, label(case), crossing_words(case))


def judge_topology(case, original, mesh):
    name = label(case)
    same = [(key, original[key], mesh[key]) for key in ("genus", "boundary_loops", "components")
            if original[key] != mesh[key]]
    verdicts = [
        verdict("exact", mesh["vertices"] == case.vertices and mesh["isolated_vertices"] == 0, name,
                f"{mesh['vertices']} vertices, {mesh['isolated_vertices']} unused"),
        verdict("manifold", mesh["edge_manifold"] and mesh["vertex_manifold"] and mesh["consistently_oriented"], name),
        verdict("topology", not same, name, ", ".join(f"{key} {a} became {b}" for key, a, b in same)),
        verdict("triangles", mesh["degenerate_triangles"] + mesh["degenerate_index_triangles"] +
                mesh["duplicate_faces"] == 0, name,
                f"{mesh['degenerate_triangles']} degenerate, {mesh['duplicate_faces']} duplicate"),
    ]
    if original.get("volume") and mesh.get("volume"):
        verdicts.append(verdict("side", original["volume"] * mesh["volume"] > 0, name))
    return verdicts


def judge_case(case):
    """The verdicts on one result."""
    found = case.result
    if found["code"] != 0:
        return [refusal(case)]
    judged = found.get("judged")
    if judged is None:
        return [verdict("exact", found["report"].get("output_vertices") == case.vertices, label(case))]
    if not judged:
        return [verdict("exact", False, label(case), "the judge could not read the result")]
    original, mesh, compared = judged["original"], judged["remeshed"], judged["compare"]
    verdicts = judge_topology(case, original, mesh)
    if "smooth" in case.bars:
        verdicts.append(judge_smooth(case, mesh, compared))
    if "crossings" in case.bars:
        verdicts.append(judge_crossings(case))
    if {"sharp", "boundary"} & case.bars:
        verdicts.append(judge_lines(case))
    if "fit" in case.bars:
        verdicts.append(judge_fit(case))
    if "density" in case.bars:
        spearman = own_compare(case).get("density_spearman")
        verdicts.append(verdict("density", spearman is not None and spearman >= 0.9, label(case), f"{spearman}"))
    if "even" in case.bars:
        verdicts.append(judge_even(case, mesh))
    if "small" in case.bars:
        verdicts.append(judge_small(case, mesh))
    if "near" in case.bars:
        verdicts += judge_near(case, compared)
    if "mass" in case.bars:
        verdicts.append(judge_mass(case))
    if "handles" in case.bars:
        flips = compared["flipped_triangles_robust"]
        verdicts.append(verdict_of("handles", label(case), [("flips", flips, flips == 0)]))
    if "arena" in case.bars:
        megabytes = found["report"]["arena_bytes"] / 1048576
        verdicts.append(verdict("arena", megabytes <= 64, label(case), f"{megabytes:.1f} MB"))
    if "time" in case.bars:
        seconds = found["report"]["seconds"]
        verdicts.append(verdict("time", seconds <= 3, label(case), f"{seconds:.2f} s"))
    return verdicts


def judge_bad(found):
    name = found["model"]
    code = found["code"]
    wrong = []
    if code is None:
        wrong.append("did not end")
    elif code == 0:
        mesh = found["judged"]
        if not mesh or mesh["vertices"] != 500 or not (mesh["edge_manifold"] and mesh["vertex_manifold"]):
            wrong.append("result is not a manifold of 500 vertices")
    elif not 10 <= code < 26 or len(found["errors"]) != 1:
        wrong.append(f"exit code {code}: " + " ".join(found["errors"])[:200])
    if not found["sanitized"]:
        if found["seconds"] > 10:
            wrong.append(f"{found['seconds']:.1f} s")
        if found["peak"] > 64 * 1048576 + 64 * found["size"]:
            wrong.append(f"{found['peak'] / 1048576:.0f} MB")
    return [verdict("broken", not wrong, name, ", ".join(wrong))]


HEADS = ["model", "V asked", "V got", "manif", "topol", "degen", "dup", "unused", "Q mean", "%<30", "least", "val 6 %",
         "cells", "Hausd %", "RMS %",
         "flips", "doubt", "cross", "lines", "sec", "MB"]


def table_row(case):
    found = case.result
    report = found["report"]
    row = [" ".join([case.model] + case.options), str(case.vertices)]
    judged = found.get("judged")
    if found["code"] != 0:
        row += [report.get("status", f"exit {found['code']}") + (f" ({found['named']})" if "named" in found else "")]
        row += [""] * 16
    elif not judged:
        row += [str(report.get("output_vertices", "?"))] + [""] * 16
    else:
        a, b, c = judged["original"], judged["remeshed"], judged["compare"]
        manifold = b["edge_manifold"] and b["vertex_manifold"] and b["consistently_oriented"]
        same = all(a[key] == b[key] for key in ("genus", "boundary_loops", "components"))
        cross = crossing_words(case) if "kinds" in found else ""
        lines = own_compare(case).get("line_worst_ratio") if {"sharp", "boundary"} & case.bars else None
        row += [str(b["vertices"]), "yes" if manifold else "NO", "same" if same else "NO", str(b["degenerate_triangles"]),
                str(b["duplicate_faces"]), str(b["isolated_vertices"]), f"{b['q_mean']:.3f}",
                f"{b['pct_tri_min_angle_lt30']:.2f}", f"{b['angle_min']:.1f}", f"{b['valence6_pct']:.1f}",
                f"{b['voronoi_area_cv']:.3f}", f"{c['hausdorff_pct']:.3f}", f"{c['rms_pct']:.4f}",
                str(c["flipped_triangles_robust"]), str(c["flipped_triangles"]),
                cross, "" if lines is None else f"{lines:.2f}"]
    return row + [f"{report.get('seconds', found['wall']):.2f}", f"{report.get('arena_bytes', 0) / 1048576:.1f}"]


def print_table(cases):
    rows = [HEADS] + [table_row(case) for case in cases]
    widths = [max(len(row[i]) for row in rows) for i in range(len(HEADS))]
    for row in rows:
        cells = [row[0].ljust(widths[0])] + [cell.rjust(width) for cell, width in zip(row[1:], widths[1:])]
        print(" ".join(cells).rstrip())


def summarize(verdicts, bars):
    print()
    for bar, text in bars.items():
        mine = [v for v in verdicts if v["bar"] == bar]
        if not mine:
            continue
        wrong = [v for v in mine if not v["good"]]
        print(f"{'BAD' if wrong else 'ok '} {bar}: {len(mine) - len(wrong)} of {len(mine)}: {text}")
        for v in mine:
            if not v["good"] or v["shown"]:
                mark = "BAD" if v["shown"] and not v["good"] else "   "
                print(f"  {mark} {v['case']}: {v['detail']}" if v["detail"] else f"      {v['case']}")
    failed = sum(not v["good"] for v in verdicts)
    print(f"{len(verdicts) - failed} passed, {failed} failed")
    return 1 if failed or not verdicts else 0
