"""Clopper and Pearson's interval of a share, for the measurements beside this file."""
import math


def binomial_end(count, trials, probability, is_upper):
    """Returns an end of the interval of Clopper and Pearson, by bisection of the binomial sum."""
    if count == (trials if is_upper else 0):
        return 1. if is_upper else 0.

    def tail(share):
        logs = (math.lgamma(trials + 1) - math.lgamma(k + 1) - math.lgamma(trials - k + 1) +
                k * math.log(share) + (trials - k) * math.log1p(-share)
                for k in (range(count + 1) if is_upper else range(count, trials + 1)))
        return sum(math.exp(value) for value in logs)

    low, high = 1e-12, 1 - 1e-12
    for _ in range(80):
        middle = (low + high) / 2
        if (tail(middle) > probability) == is_upper:
            low = middle
        else:
            high = middle
    return low
