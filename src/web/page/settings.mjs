// settings.mjs: settings in the browser's storage, which the browser may block. Blocked settings are not remembered.

// Returns the text of a setting, or null.
export function readSetting(place) {
    try {
        return localStorage.getItem(place);
    } catch {
        return null;
    }
}

export function storeSetting(place, text) {
    try {
        localStorage.setItem(place, text);
    } catch {
        // the next visit has the default
    }
}
