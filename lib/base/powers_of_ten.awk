# powers_of_ten.awk: computes the rows of powers_of_ten.h for shortest.c, from 10^-292 to 10^324.
#
# A row has the first 128 bits of the power, rounded down, plus 1. Numbers are arrays of digits in base 2^16, the least
# significant first. Rounding each quotient down rounds the last one down as well.

# print_row(limb, top): prints the row of a number whose highest digit is limb[top].
function print_row(limb, top,    shift, i, word, carry) {
    for (shift = 1; limb[top] * shift < 32768; shift *= 2)
        ;
    carry = 1
    for (i = top - 7; i <= top; i++) {
        word = limb[i] * shift % 65536 + int(limb[i - 1] * shift / 65536) + carry
        carry = word == 65536
        row[top - i] = sprintf("%04x", word % 65536)
    }
    failed = failed || carry
    printf "{0x"
    for (i = 0; i < 4; i++)
        printf "%s", row[i]
    printf ", 0x"
    for (; i < 8; i++)
        printf "%s", row[i]
    printf "},\n"
}

BEGIN {
    low = -292
    high = 324
    # 2^1120 / 10^n
    top = 70
    limb[top] = 1
    for (n = 1; n <= -low; n++) {
        rest = 0
        for (i = top; i >= 0; i--) {
            rest = rest * 65536 + limb[i]
            limb[i] = int(rest / 10)
            rest %= 10
        }
        while (limb[top] == 0)
            top--
        for (i = top - 8; i <= top; i++)
            quotient[n, i] = limb[i]
        first[n] = top
    }
    print "// powers_of_ten.h: made by powers_of_ten.awk."
    for (n = -low; n >= 1; n--) {
        for (i = first[n] - 8; i <= first[n]; i++)
            limb[i] = quotient[n, i]
        print_row(limb, first[n])
    }
    # 10^n, above eight digits of 0
    for (i = 0; i <= 8; i++)
        limb[i] = i == 8
    top = 8
    for (n = 0; n <= high; n++) {
        print_row(limb, top)
        carry = 0
        for (i = 0; i <= top; i++) {
            word = limb[i] * 10 + carry
            limb[i] = word % 65536
            carry = int(word / 65536)
        }
        if (carry)
            limb[++top] = carry
    }
    exit failed
}
