"""Writes tests/data/mie_corners.csv: Mie sums at the corners of the kernel's range, in 60- to 100-digit arithmetic.

    pip install mpmath && python tools/tables/mie_corners.py > tests/data/mie_corners.csv      (about a minute)

Textbook formulae (Bohren & Huffman 1983, Eq. 4.61, 4.62, 4.88 and Sec. 4.8), independent of the Rust code: the logarithmic
derivative instead of ratios, far more orders than needed, and differences that so many digits can afford.
"""

from mpmath import cos, mp, mpc, mpf, nstr, sin

SIZES = ["1e-6", "1e-4", "0.01", "0.5", "3", "30.5", "300.25"]
INDICES = [("0.1", "0"), ("0.1", "10"), ("10", "0"), ("10", "10"), ("10", "1e-8"), ("1.000001", "0"), ("1", "1e-6"),
           ("1.333", "1e-9"), ("0.1", "1e-7"), ("1.5", "3"), ("3", "0")]
LARGE = [("1.333", "0", "5000"), ("1.333", "1e-9", "30000.7"), ("10", "10", "20000"), ("10", "1e-6", "5000.1"),
         ("0.1", "0", "4000.3"), ("0.75", "1e-4", "9999"), ("1.333", "1e-5", "100000")]


def logarithmic_derivative(z, last):
    """D_0 … D_last of ψ_n(z), by downward recursion."""
    modulus = int(abs(z))
    start = max(last, modulus + int(14 * mpf(modulus + 1) ** (mpf(1) / 3))) + 200
    out, d = [None] * (last + 1), mpc(0)
    for n in range(start, 0, -1):
        ratio = n / z
        d = ratio - 1 / (d + ratio)
        if n - 1 <= last:
            out[n - 1] = d
    return out


def riccati_bessel(x, last):
    """ψ_n(x) and χ_n(x) for n = 0 … last."""
    ratio, u = [None] * (last + 2), mpf(0)
    for n in range(max(last, int(x)) + 200, 0, -1):
        u = 1 / ((2 * n + 1) / x - u)
        if n <= last:
            ratio[n] = u
    psi = [sin(x)]
    if x < 1:
        for n in range(1, last + 1):
            psi.append(psi[-1] * ratio[n])
    else:
        psi.append(sin(x) / x - cos(x))
        for n in range(1, last):
            psi.append((2 * n + 1) / x * psi[n] - psi[n - 1] if n < x else psi[n] * ratio[n + 1])
    chi = [cos(x), cos(x) / x + sin(x)]
    for n in range(1, last):
        chi.append((2 * n + 1) / x * chi[n] - chi[n - 1])
    return psi, chi


def sums(m, x):
    """q_ext, q_sca, q_abs, q_back, g."""
    last = int(x + 12 * x ** (mpf(1) / 3)) + 12
    d = logarithmic_derivative(m * x, last)
    psi, chi = riccati_bessel(x, last)
    a, b = [], []
    for n in range(1, last + 1):
        xi, xi_before = mpc(psi[n], -chi[n]), mpc(psi[n - 1], -chi[n - 1])
        for coefficients, factor in ((a, d[n] / m + n / x), (b, m * d[n] + n / x)):
            coefficients.append((factor * psi[n] - psi[n - 1]) / (factor * xi - xi_before))
    ext, sca, back, cosine = mpf(0), mpf(0), mpc(0), mpf(0)
    for n in range(1, last + 1):
        an, bn = a[n - 1], b[n - 1]
        ext += (2 * n + 1) * (an + bn).real
        sca += (2 * n + 1) * (abs(an) ** 2 + abs(bn) ** 2)
        back += (2 * n + 1) * (-1) ** n * (an - bn)
        cosine += mpf(2 * n + 1) / (n * (n + 1)) * (an * bn.conjugate()).real
        if n < last:
            next_order = (an * a[n].conjugate() + bn * b[n].conjugate()).real
            cosine += mpf(n * (n + 2)) / (n + 1) * next_order
    return 2 * ext / x**2, 2 * sca / x**2, 2 * (ext - sca) / x**2, abs(back) ** 2 / x**2, 2 * cosine / sca


def main():
    print("n,k,x,q_ext,q_sca,q_abs,q_back,g")
    for n, k, x in [(n, k, x) for x in SIZES for n, k in INDICES] + LARGE:
        mp.dps = 100 if float(x) < 1 else 60
        values = sums(mpc(mpf(n), mpf(k)), mpf(x))
        cells = ["0" if i == 2 and k == "0" else nstr(v, 17) for i, v in enumerate(values)]
        print(",".join([n, k, x, *cells]), flush=True)


if __name__ == "__main__":
    main()
