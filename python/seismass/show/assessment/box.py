"""The box at the top of an assessment's page: doubts, the pair of analyses, what governs, why, on which motions."""

from __future__ import annotations

from markupsafe import Markup

from seismass.media.isolate import sentence_html
from seismass.model.codes import AS_STATED, NOT_CHECKED, VERIFIED
from seismass.show.assessment.tables import AssessmentTables


def box_class(result: AssessmentTables) -> str:
    """Return the class of the box: green only with an answer, without doubts, and with all checks met."""
    met = result.checks["met"].eq_missing(True).all()
    return "answer" if result.answer is not None and met and not result.document["doubts"] else "answer bad"


def answer_lines(result: AssessmentTables) -> list[Markup]:
    """Return the lines of the box."""
    document, answer = result.document, result.answer
    names = result.storey_names
    lines = [Markup('<strong class="warn">{}</strong>').format(doubt) for doubt in document["doubt_lines"]]
    lines.append(Markup("<strong>{}</strong>").format(sentence_html(_sentence(document["statement"]), names)))
    if answer is not None:
        pair = zip(answer["analyses"], answer["pair"], strict=True)
        lines += [
            Markup("<strong>{}</strong>").format(sentence_html(f"Analysis {one['number']}: {words}."))
            for one, words in pair
        ]
        said = (f"Governs: {'; '.join(answer['governs'])}.", f"Why: {answer['why']}.", _sentence(answer["design"]))
        lines += [sentence_html(line, names) for line in (said[0], f"Goods present: {answer['goods']}.", *said[1:])]
    lines.append(sentence_html(_sentence(document["on_motions"])))
    if result.effective:
        lines.append(sentence_html(_code_sentence(result)))
    lines.append(_verdicts(result))
    return lines


def _sentence(text: str) -> str:
    return f"{text[0].upper()}{text[1:]}."


def _code_sentence(result: AssessmentTables) -> str:
    """The code's fraction on the base of the shares, with its own in brackets."""
    code = result.code
    unchecked = "" if code["status"] in (VERIFIED, AS_STATED) else f"; {NOT_CHECKED}"
    return (
        f"{code['code']}: {code['share_of_design_live_load'] / result.present_share:.2f} of the goods present "
        f"({code['share_of_design_live_load']:.3g} of the design live load{unchecked})."
    )


def _single_motions(result: AssessmentTables) -> str:
    """Under how many motions a drift is above the limit all the same."""
    above = result.storeys["motions_above_limit"].drop_nulls().to_numpy()
    motions = len(result.document["suite"]["motions"])
    return f"; under up to {above.max()} of {motions} a drift is above the limit" if above.size and above.max() else ""


def _verdicts(result: AssessmentTables) -> Markup:
    """How many checks are met; those without a value are counted apart."""
    count = result.checks.height
    failed = result.checks.filter(met=False).height
    missing = result.checks["met"].null_count()
    if not failed + missing:
        return Markup('<span class="good">All {} checks are met, in the mean over the motions{}.</span>').format(
            count, _single_motions(result)
        )
    said = [f"{failed} of {count} checks are not met"] * bool(failed)
    said += [f"{missing} of {count} have no value, since runs collapse"] * bool(missing)
    return Markup('<span class="warn">{}.</span>').format("; ".join(said))
