"""What became of the mutants."""
import collections
import csv
import dataclasses

PASS_SCORE = 0.95      # of the mutants that are not equivalent
MOST_EQUIVALENT = 0.1  # of all that were drawn


@dataclasses.dataclass
class Result:
    label: str     # number in the draw, or name
    named: bool
    file: str
    line: int
    text: str      # the line
    mutation: str  # "old -> new"
    status: str    # killed, survived, equivalent, or contradicted: listed as equivalent, but killed
    program: str   # that killed it
    reason: str


def write_csv(path, results):
    with open(path, "w", encoding="utf-8", newline="") as file:
        writer = csv.writer(file)
        writer.writerow(field.name for field in dataclasses.fields(Result))
        writer.writerows(dataclasses.astuple(result) for result in results)


def show(result):
    return "{}  {}:{}\n    {}\n    {}".format(
        result.label, result.file, result.line, result.text, result.mutation)


def summarise(results, invalid, seconds):
    """Prints survivors and totals; returns whether that is good enough."""
    for status in ("survived", "contradicted"):
        chosen = [result for result in results if result.status == status]
        if chosen:
            print("\n{}:".format(status))
            print("\n".join(map(show, chosen)))
    drawn = [result for result in results if not result.named]
    named = [result for result in results if result.named]
    count = collections.Counter(result.status for result in drawn)
    killed = count["killed"] + count["contradicted"]
    asked = len(drawn) - count["equivalent"]
    score = killed / asked if asked else 1.0
    print("\n{} drawn: {} killed, {} survived, {} equivalent; {} invalid (do not compile), not "
          "counted".format(len(drawn), killed, count["survived"], count["equivalent"], invalid))
    print("score: {:.1%} of those not equivalent, {:.1%} of all drawn; needed: {:.0%} of the "
          "former".format(score, killed / len(drawn) if drawn else 1.0, PASS_SCORE))
    good = score >= PASS_SCORE
    if named:
        named_killed = sum(result.status == "killed" for result in named)
        print("named: {} of {} killed; needed: all".format(named_killed, len(named)))
        good = good and named_killed == len(named)
    if count["equivalent"] > MOST_EQUIVALENT * len(drawn):
        print("too many are excused as equivalent: at most {:.0%}".format(MOST_EQUIVALENT))
        good = False
    if count["contradicted"]:
        print("tests kill what is listed as equivalent: correct the list")
        good = False
    print("time: {:.0f} min {:02.0f} s".format(*divmod(round(seconds), 60)))
    return good
